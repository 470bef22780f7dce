#include "quadmap/odometry/OdometryInput.h"

#include <mrpt/core/format.h>

#include <utility>

#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** Pose of the robot at the origin of the map, with the smallest rotation that turns `up` to z. A
 * robot on its head rolls onto its feet before, so that it looks ahead as any other. */
CPose3D uprightStart(const Eigen::Vector3d& up_robot)
{
  Eigen::Quaterniond roll = Eigen::Quaterniond::Identity();
  if (up_robot.z() < 0) roll = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
  const Eigen::Vector3d up = roll * up_robot;
  const Eigen::Matrix3d R = (turnToZ(up) * roll).toRotationMatrix();
  return CPose3D::FromRotationAndTranslation(R, Eigen::Vector3d(Eigen::Vector3d::Zero()));
}

}  // namespace

OdometryInput::OdometryInput(
    PoseSource source,
    const PoseUncertaintyOptions& uncertainty,
    const VisualOdometryOptions& visual,
    const Eigen::Vector3d& up_robot,
    const std::optional<GraphOdometry>& graph) :
    source_(source), uncertainty_(uncertainty), graph_(graph)
{
  if (source == PoseSource::Visual)
    visual_ = std::make_unique<VisualOdometry>(visual, uprightStart(up_robot));
}

std::optional<CPose3D> OdometryInput::poseOf(const RgbdFrame& frame)
{
  sawOdometry_ = sawOdometry_ || frame.T_odom_robot;
  sawGroundTruth_ = sawGroundTruth_ || frame.T_world_robot;
  latest_.reset();
  const bool isOfOtherCamera =
      visual_ && !visualSensor_.empty() && frame.scan->sensorLabel != visualSensor_;
  if (!graph_ && !isOfOtherCamera) ++placeable_;
  const auto pose = visual_ ? visualPoseOf(frame) : givenPoseOf(frame);
  if (!pose) return std::nullopt;
  ++posed_;
  latest_.emplace(*pose, frame.odometryCovariance.value_or(mrpt::math::CMatrixDouble66()));
  // Visual odometry tells of its own failures.
  if (!visual_) jumps_.add(frame, *pose);
  return pose;
}

std::optional<CPose3D> OdometryInput::givenPoseOf(const RgbdFrame& frame)
{
  if (graph_) return graph_->poseAt(frame.time());
  return source_ == PoseSource::GroundTruth ? frame.T_world_robot : frame.T_odom_robot;
}

std::optional<CPose3D> OdometryInput::visualPoseOf(const RgbdFrame& frame)
{
  const std::string& sensor = frame.scan->sensorLabel;
  if (visual_->counts().frames == 0) visualSensor_ = sensor;
  if (sensor == visualSensor_) return visual_->add(*frame.scan);
  if (!std::exchange(sawOtherSensor_, true))
    warnings_.push_back(
        "visual odometry uses one camera, " + visualSensor_ + ": the images of " + sensor +
        " have no poses");
  return std::nullopt;
}

CPose3D OdometryInput::poseOfMoment()
{
  latest_.emplace(CPose3D(), mrpt::math::CMatrixDouble66());
  return latest_->mean;
}

std::optional<CPose3DPDFGaussian> OdometryInput::keyframeStep()
{
  if (visual_) return visual_->takeStep();
  if (graph_) return graph_->takeStep(uncertainty_);
  std::optional<CPose3DPDFGaussian> step;
  if (keyframe_ && latest_ && source_ == PoseSource::GroundTruth)
    step = groundTruthStep(uncertainty_, keyframe_->mean, latest_->mean);
  else if (keyframe_ && latest_)
    step = odometryStep(uncertainty_, *keyframe_, *latest_);
  keyframe_ = latest_;
  return step;
}

std::optional<VisualOdometryCounts> OdometryInput::visualCounts() const
{
  if (!visual_) return std::nullopt;
  return visual_->counts();
}

std::vector<std::string> OdometryInput::takeWarnings()
{
  auto warnings = std::exchange(warnings_, {});
  if (visual_)
    for (auto& text : visual_->takeWarnings()) warnings.push_back(std::move(text));
  return warnings;
}

void OdometryInput::requireAllUsed() const
{
  if (graph_) graph_->requireAllUsed();
}

std::string OdometryInput::missingPoses() const
{
  if (posed_ >= placeable_) return {};
  return mrpt::format("%zu of %zu images have no pose", placeable_ - posed_, placeable_);
}

std::string OdometryInput::whyNoPoses() const
{
  if (graph_) return "no image has the time of a pose of " + graph_->path();
  if (source_ == PoseSource::Visual && sawOdometry_)
    return "visual odometry finds too little texture or depth in the images: use --odometry rawlog";
  if (source_ == PoseSource::Visual)
    return "no odometry for any image, and visual odometry finds too little texture or depth in "
           "them";
  if (source_ == PoseSource::GroundTruth)
    return sawOdometry_ ? "no ground truth poses for any image, but odometry: use --odometry rawlog"
                        : "no ground truth poses for any image";
  return sawGroundTruth_
             ? "no odometry for any image, but ground truth poses: use --odometry ground-truth"
             : "no odometry for any image: use --odometry visual";
}

}  // namespace quadmap
