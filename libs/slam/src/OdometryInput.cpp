#include "quadmap/slam/OdometryInput.h"

namespace quadmap
{
using mrpt::poses::CPose3DPDFGaussian;

std::optional<mrpt::poses::CPose3D> OdometryInput::poseOf(const RgbdFrame& frame)
{
  sawOdometry_ = sawOdometry_ || frame.T_odom_robot;
  sawGroundTruth_ = sawGroundTruth_ || frame.T_world_robot;
  const auto& pose = source_ == PoseSource::GroundTruth ? frame.T_world_robot : frame.T_odom_robot;
  latest_.reset();
  if (pose)
    latest_.emplace(*pose, frame.odometryCovariance.value_or(mrpt::math::CMatrixDouble66()));
  return pose;
}

std::optional<CPose3DPDFGaussian> OdometryInput::keyframeStep()
{
  std::optional<CPose3DPDFGaussian> step;
  if (keyframe_ && latest_ && source_ == PoseSource::GroundTruth)
    step = groundTruthStep(uncertainty_, keyframe_->mean, latest_->mean);
  else if (keyframe_ && latest_)
    step = odometryStep(uncertainty_, *keyframe_, *latest_);
  keyframe_ = latest_;
  return step;
}

std::string OdometryInput::whyNoPoses() const
{
  if (source_ == PoseSource::GroundTruth)
    return sawOdometry_ ? "no ground truth poses for any image, but odometry: use --odometry rawlog"
                        : "no ground truth poses for any image";
  return sawGroundTruth_
             ? "no odometry for any image, but ground truth poses: use --odometry ground-truth"
             : "no odometry for any image: without poses there is no map";
}

}  // namespace quadmap
