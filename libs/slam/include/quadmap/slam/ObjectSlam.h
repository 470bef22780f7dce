#pragma once

#include <mrpt/system/COutputLogger.h>

#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/FramePerception.h"
#include "quadmap/perception/RoomPlanes.h"
#include "quadmap/sensors/RgbdFrame.h"
#include "quadmap/slam/KeyframeSelector.h"
#include "quadmap/slam/KeyframeSpool.h"
#include "quadmap/slam/ModuleTimes.h"
#include "quadmap/slam/OdometryInput.h"
#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/SlamResult.h"
#include "quadmap/slam/backend/BackEnd.h"

namespace quadmap
{
/** Something is wrong with this one frame; the next ones may be fine. */
struct BadFrame : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** RGB-D frames with boxes in, trajectory and object map out: keyframes are measured, their
 * measurements go into the map, and correct the odometry's poses on the way. Ground truth poses are
 * taken as given. */
class ObjectSlam : public mrpt::system::COutputLogger
{
 public:
  /** \param spool Takes the images; must outlive this object.
   *  \param up_robot See OdometryInput. */
  ObjectSlam(
      const SlamConfiguration& configuration,
      const LabelTable& labels,
      KeyframeSpool& spool,
      const std::optional<Eigen::Vector3d>& up_robot = {});

  /** \return True when the frame became a keyframe.
   *  \exception BadFrame The frame is unusable and was left out. */
  bool addFrame(const RgbdFrame& frame);

  /** After the last frame: settles the map.
   *  \exception std::runtime_error If there were frames, but none had a pose. */
  void finish();

  const SlamResult& result() const { return result_; }
  ModuleTimes& times() { return times_; }

  /** Logs a warning and keeps it for the report. */
  void warn(const std::string& text);

 private:
  std::optional<mrpt::poses::CPose3D> poseOf(const RgbdFrame& frame);
  void tellOdometry(const RgbdFrame& frame);
  bool addPosedFrame(const RgbdFrame& frame, const mrpt::poses::CPose3D& T_odom_robot);
  void keepWhileOneMoment(const RgbdFrame& frame);
  void measureBoxes(
      const RgbdFrame& frame, CObservationObjects& boxes, const mrpt::poses::CPose3D& T_map_sensor);
  /** \return The keyframe's pose, corrected. */
  mrpt::poses::CPose3D insertIntoMap(
      const CObservationObjects* boxes,
      const std::optional<mrpt::poses::CPose3DPDFGaussian>& step,
      const mrpt::poses::CPose3D& T_odom_robot);
  void correctEverything();
  void count(const CObservationObjects& boxes);
  void warnOfMissingDepth();
  void warnOfUnknownLabels(const CObservationObjects& boxes);

  SlamConfiguration configuration_;
  LabelTable labels_;
  KeyframeSpool& spool_;
  FramePerception perception_;
  RoomPlanes room_;
  KeyframeSelector selector_;
  OdometryInput odometry_;
  std::unique_ptr<BackEnd> backEnd_;
  SlamResult result_;
  ModuleTimes times_;
  bool hasOneMoment_ = true;            //!< No frame had a pose, and all are of one moment:
  std::vector<RgbdFrame> withoutPose_;  //!< these; each of another sensor
  std::set<std::string> unknownLabels_;
};

}  // namespace quadmap
