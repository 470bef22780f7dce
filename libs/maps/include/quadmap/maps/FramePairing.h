#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <deque>
#include <map>
#include <optional>
#include <string>

#include "quadmap/maps/UncertainPose.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Finds the range scan and the boxes of the same frame (equal sensor label and time stamp) when
 * they arrive one after the other, in either order. It keeps the last few of each sensor that wait
 * for a partner. */
class FramePairing
{
 public:
  struct Frame
  {
    mrpt::obs::CObservation3DRangeScan::ConstPtr scan;
    CObservationObjects boxes;
    UncertainPose robotPose;  //!< The boxes were inserted at
  };

  /** \return The complete frame, or nothing while the partner is missing.
   *  \exception std::invalid_argument If scan and boxes have different cameras or sensor poses. The
   *  message names the sensor and the difference. Both are forgotten. */
  std::optional<Frame> add(const mrpt::obs::CObservation3DRangeScan& scan);
  std::optional<Frame> add(const CObservationObjects& boxes, const UncertainPose& robotPose);

  /** The waiting scan of the frame of these boxes, or null.
   *  \exception std::invalid_argument As for add(); the scan goes on waiting. */
  mrpt::obs::CObservation3DRangeScan::ConstPtr scanOf(const CObservationObjects& boxes) const;

  void clear();

 private:
  struct WaitingBoxes
  {
    CObservationObjects boxes;
    UncertainPose robotPose;
  };
  std::map<std::string, std::deque<mrpt::obs::CObservation3DRangeScan::ConstPtr>> scans_;
  std::map<std::string, std::deque<WaitingBoxes>> boxes_;  // both by sensor
};

}  // namespace quadmap
