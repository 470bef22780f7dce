#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/sensors/RgbdFrame.h"
#include "quadmap/slam/GraphOdometry.h"
#include "quadmap/slam/PoseUncertainty.h"
#include "quadmap/slam/SlamOptions.h"
#include "quadmap/slam/visual/VisualOdometry.h"

namespace quadmap
{
/** Gives every frame the pose it enters the estimation with, and keyframes the edge between them.
 */
class OdometryInput
{
 public:
  /** \param source Auto is taken as Rawlog; see surveyOdometry() for what else it may come to.
   *  \param up_robot For visual odometry: up at the first frame, in the robot's frame; when absent
   * the robot is thought to stand upright then.
   *  \param graph For PoseSource::Graph. */
  OdometryInput(
      PoseSource source,
      const PoseUncertaintyOptions& uncertainty,
      const VisualOdometryOptions& visual,
      const std::optional<Eigen::Vector3d>& up_robot = {},
      const std::optional<GraphOdometry>& graph = {});

  /** T_map_robot of the frame, or nothing when the input has none at its time.
   *  \exception std::runtime_error As GraphOdometry::poseAt(). */
  std::optional<mrpt::poses::CPose3D> poseOf(const RgbdFrame& frame);

  /** For a frame of a recording that has no poses because it is of a single moment, instead of
   * poseOf(): the origin of the map. */
  mrpt::poses::CPose3D poseOfMoment();

  /** To be called once for every keyframe, after one of these gave its pose: the motion of the
   * robot since the keyframe before, with its covariance (x, y, z, yaw, pitch, roll), always
   * positive definite. Nothing for the first keyframe. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> keyframeStep();

  /** After the last frame. \exception std::runtime_error As GraphOdometry::requireAllUsed(). */
  void requireAllUsed() const;

  PoseSource source() const { return source_; }
  std::optional<VisualOdometryCounts> visualCounts() const;  //!< When it is used
  const std::string& visualSensor() const { return visualSensor_; }

  std::vector<std::string> takeWarnings();  //!< Since the last call, one line each

  /** What to tell the user when no frame got a pose. */
  std::string whyNoPoses() const;

 private:
  std::optional<mrpt::poses::CPose3D> visualPoseOf(const RgbdFrame& frame);

  PoseSource source_;
  PoseUncertaintyOptions uncertainty_;
  std::unique_ptr<VisualOdometry> visual_;
  std::optional<GraphOdometry> graph_;
  std::string visualSensor_;  //!< The one camera it uses; empty: none yet
  std::optional<mrpt::poses::CPose3DPDFGaussian> latest_, keyframe_;  //!< Poses, as given
  std::vector<std::string> warnings_;
  bool sawOdometry_ = false, sawGroundTruth_ = false, sawOtherSensor_ = false;
};

}  // namespace quadmap
