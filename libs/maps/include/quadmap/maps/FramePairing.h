#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <deque>
#include <map>
#include <optional>
#include <string>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Finds the range scan and the boxes of the same frame (equal sensor label and time stamp) when
 * they arrive one after the other, in either order. Keeps the last few of each sensor that wait for
 * a partner. */
class FramePairing
{
 public:
  struct Frame
  {
    mrpt::obs::CObservation3DRangeScan::ConstPtr scan;
    CObservationObjects boxes;
    mrpt::poses::CPose3D robotPose;  //!< The boxes were inserted at
  };

  /** The complete frame, or nothing while the partner is missing. */
  std::optional<Frame> add(const mrpt::obs::CObservation3DRangeScan& scan);
  std::optional<Frame> add(const CObservationObjects& boxes, const mrpt::poses::CPose3D& robotPose);

  void clear();

 private:
  struct WaitingBoxes
  {
    CObservationObjects boxes;
    mrpt::poses::CPose3D robotPose;
  };
  std::map<std::string, std::deque<mrpt::obs::CObservation3DRangeScan::ConstPtr>> scans_;
  std::map<std::string, std::deque<WaitingBoxes>> boxes_;  // both by sensor
};

}  // namespace quadmap
