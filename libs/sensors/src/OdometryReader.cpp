#include "OdometryReader.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <Eigen/Dense>
#include <stdexcept>

#include "quadmap/sensors/RawlogNames.h"

namespace quadmap
{
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** A covariance with broken numbers is as good as none. */
CPose3DPDFGaussian withUsableCovariance(CPose3DPDFGaussian pose)
{
  if (!pose.cov.asEigen().allFinite()) pose.cov.setZero();
  return pose;
}

std::optional<CPose3DPDFGaussian> movementIn(const mrpt::obs::CActionCollection& actions)
{
  CPose3DPDFGaussian increment;
  if (actions.getFirstMovementEstimation(increment)) return increment;
  if (const auto move = actions.getActionByClass<mrpt::obs::CActionRobotMovement3D>())
    return move->poseChange;
  if (const auto move = actions.getBestMovementEstimation())
  {
    increment.copyFrom(*move->poseChange);
    return increment;
  }
  return std::nullopt;
}

double secondsOf(const mrpt::obs::CObservation& observation)
{
  if (observation.timestamp == INVALID_TIMESTAMP) throw std::runtime_error("has no time stamp");
  return mrpt::Clock::toDouble(observation.timestamp);
}
}  // namespace

bool OdometryReader::accept(const std::string& kind)
{
  if (kind_.empty()) kind_ = kind;
  if (kind_ == kind) return true;
  ignoredKind_ = kind;
  return false;
}

bool OdometryReader::read(const mrpt::obs::CObservation& observation)
{
  using mrpt::obs::CObservationOdometry;
  using mrpt::obs::CObservationRobotPose;
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation))
  {
    if (accept("CObservationOdometry " + odometry->sensorLabel))
      track_.add(
          secondsOf(*odometry), CPose3DPDFGaussian(mrpt::poses::CPose3D(odometry->odometry)));
    return true;
  }
  if (const auto* pose = dynamic_cast<const CObservationRobotPose*>(&observation))
  {
    if (pose->sensorLabel == kGroundTruthLabel)
      truth_.add(secondsOf(*pose), CPose3DPDFGaussian(pose->pose.mean));
    else if (accept("CObservationRobotPose " + pose->sensorLabel))
      track_.add(secondsOf(*pose), withUsableCovariance(pose->pose));
    return true;
  }
  return false;
}

void OdometryReader::read(const mrpt::obs::CActionCollection& actions)
{
  const auto increment = movementIn(actions);
  if (!increment || !accept("CActionRobotMovement")) return;
  countsActions_ = true;
  if (!isFinite(increment->mean))
    throw std::runtime_error("the movement has numbers that are not finite");
  sumOfActions_ += withUsableCovariance(*increment);
}

void OdometryReader::forgetBefore(double time)
{
  track_.forgetBefore(time);
  truth_.forgetBefore(time);
}

}  // namespace quadmap
