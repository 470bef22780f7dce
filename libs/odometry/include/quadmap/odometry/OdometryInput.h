#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/odometry/GraphOdometry.h"
#include "quadmap/odometry/ImpossibleSteps.h"
#include "quadmap/odometry/PoseSource.h"
#include "quadmap/odometry/PoseUncertainty.h"
#include "quadmap/odometry/VisualOdometry.h"
#include "quadmap/sensors/RgbdFrame.h"

namespace quadmap
{
/** Gives every frame the pose with which it enters the estimation, and every keyframe the step from
 * the keyframe before. */
class OdometryInput
{
 public:
  /** \param source Auto is treated as Rawlog. surveyOdometry() replaces Auto by something better.
   *  \param up_robot Direction that is up at the first frame, in the robot's frame, for visual
   *  odometry.
   *  \param graph The poses of PoseSource::Graph. */
  OdometryInput(
      PoseSource source,
      const PoseUncertaintyOptions& uncertainty,
      const VisualOdometryOptions& visual,
      const Eigen::Vector3d& up_robot = Eigen::Vector3d::UnitZ(),
      const std::optional<GraphOdometry>& graph = {});

  /** T_map_robot of the frame, or nothing when the input has none at its time.
   *  \exception std::runtime_error As GraphOdometry::poseAt(). */
  std::optional<mrpt::poses::CPose3D> poseOf(const RgbdFrame& frame);

  /** The pose of a frame of a recording of a single moment, which has no poses: the origin of the
   *  map. Call it instead of poseOf(). */
  mrpt::poses::CPose3D poseOfMoment();

  /** Motion of the robot since the keyframe before, with its covariance (x, y, z, yaw, pitch,
   * roll), which is positive definite; nothing for the first keyframe. Call it once for every
   * keyframe, after poseOf() or poseOfMoment() gave its pose. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> keyframeStep();

  /** Call it after the last frame. \exception std::runtime_error As
   * GraphOdometry::requireAllUsed(). */
  void requireAllUsed() const;

  PoseSource source() const { return source_; }
  std::optional<VisualOdometryCounts> visualCounts() const;  //!< Set when visual odometry is used
  const std::string& visualSensor() const { return visualSensor_; }

  std::vector<std::string> takeWarnings();  //!< Those since the last call, one line each

  /** What to tell the user after the last frame when given poses are doubtful; empty otherwise. */
  std::string warningOfJumps() const { return jumps_.warning(); }

  /** What to tell the user after the last frame when a given graph does not fit the frames; empty
   * otherwise. */
  std::string warningOfGraph() const { return graph_ ? graph_->warning() : std::string(); }

  /** How many images have no pose, for messages: "3 of 8 images have no pose"; empty when all have
   * one. Images that cannot have one do not count: those of further cameras with visual odometry,
   * and those between the keyframes of a graph. */
  std::string missingPoses() const;

  /** Most images have no pose, although poses are given: what is made of the others is no result
   * for the recording. Visual odometry may lose its way, and tells where. */
  bool lacksMostPoses() const { return !visual_ && 2 * posed_ < placeable_; }

  /** What to tell the user when no frame got a pose. */
  std::string whyNoPoses() const;

 private:
  std::optional<mrpt::poses::CPose3D> givenPoseOf(const RgbdFrame& frame);
  std::optional<mrpt::poses::CPose3D> visualPoseOf(const RgbdFrame& frame);

  PoseSource source_;
  PoseUncertaintyOptions uncertainty_;
  std::unique_ptr<VisualOdometry> visual_;
  std::optional<GraphOdometry> graph_;
  std::string visualSensor_;  //!< The camera of visual odometry; empty before the first
  std::optional<mrpt::poses::CPose3DPDFGaussian> latest_,
      keyframe_;  //!< Poses, as the input gave them
  ImpossibleSteps jumps_;
  std::size_t placeable_ = 0, posed_ = 0;  // images that should have poses, and that have one
  std::vector<std::string> warnings_;
  bool sawOdometry_ = false, sawGroundTruth_ = false, sawOtherSensor_ = false;
};

}  // namespace quadmap
