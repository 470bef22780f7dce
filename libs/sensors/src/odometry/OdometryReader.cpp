#include "odometry/OdometryReader.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "quadmap/sensors/RawlogNames.h"
#include "records/RecordTime.h"

namespace quadmap
{
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** The pose, with a covariance of zero (unknown) when it has numbers that are not finite. */
CPose3DPDFGaussian withFiniteCovariance(CPose3DPDFGaussian pose)
{
  if (!pose.cov.asEigen().allFinite()) pose.cov.setZero();
  return pose;
}

struct Movement
{
  std::string kind;
  CPose3DPDFGaussian increment;
};

/** Covariance of a motion by Thrun's motion model, linearised. MRPT draws particles from this model
 * instead each time the action is read, with random numbers that differ from run to run. */
mrpt::math::CMatrixDouble33 thrunCovariance(
    const mrpt::poses::CPose2D& increment,
    const mrpt::obs::CActionRobotMovement2D::TMotionModelOptions::TOptions_ThrunModel& model)
{
  const double moved = increment.norm();
  const double turn1 = moved > 0 ? std::atan2(increment.y(), increment.x()) : 0;
  const double turn2 = mrpt::math::wrapToPi(increment.phi() - turn1);
  const double sigma1 = model.alfa1_rot_rot * std::abs(turn1) + model.alfa2_rot_trans * moved;
  const double sigma2 = model.alfa1_rot_rot * std::abs(turn2) + model.alfa2_rot_trans * moved;
  const double sigmaMove =
      model.alfa3_trans_trans * moved + model.alfa4_trans_rot * (std::abs(turn1) + std::abs(turn2));
  Eigen::Matrix3d J;  // derivatives of (x, y, phi) by (turn1, move, turn2), times their sigmas
  J.col(0) = sigma1 * Eigen::Vector3d(-increment.y(), increment.x(), 1);
  J.col(1) = sigmaMove * Eigen::Vector3d(std::cos(turn1), std::sin(turn1), 0);
  J.col(2) = sigma2 * Eigen::Vector3d(0, 0, 1);
  const double atLeast = model.additional_std_XY, turnAtLeast = model.additional_std_phi;
  const Eigen::Vector3d more(atLeast * atLeast, atLeast * atLeast, turnAtLeast * turnAtLeast);
  const Eigen::Matrix3d added = more.asDiagonal();
  return mrpt::math::CMatrixDouble33(Eigen::Matrix3d(J * J.transpose() + added));
}

CPose3DPDFGaussian incrementOf(const mrpt::obs::CActionRobotMovement2D& move)
{
  using Move = mrpt::obs::CActionRobotMovement2D;
  CPose3DPDFGaussian increment;
  const auto& model = move.motionModelConfiguration;
  if (move.estimationMethod == Move::emOdometry && model.modelSelection == Move::mmThrun)
  {
    const mrpt::poses::CPose2D& read = move.rawOdometryIncrementReading;
    increment.copyFrom(
        mrpt::poses::CPosePDFGaussian(read, thrunCovariance(read, model.thrunModel)));
  }
  else
    increment.copyFrom(*move.poseChange);
  return increment;
}

/** The best motion of an action: three dimensions come before two, and matched scans before wheels.
 */
std::optional<Movement> movementIn(const mrpt::obs::CActionCollection& actions)
{
  using mrpt::obs::CActionRobotMovement2D;
  const CActionRobotMovement2D* planar = nullptr;
  for (const auto& action : actions)
  {
    if (const auto* move =
            dynamic_cast<const mrpt::obs::CActionRobotMovement3D*>(action.get_ptr().get()))
      return Movement{"CActionRobotMovement3D", move->poseChange};
    const auto* move = dynamic_cast<const CActionRobotMovement2D*>(action.get_ptr().get());
    const bool isBetter =
        move && move->estimationMethod == CActionRobotMovement2D::emScan2DMatching;
    if (move && (!planar || isBetter)) planar = move;
  }
  if (!planar) return std::nullopt;
  return Movement{"CActionRobotMovement2D", incrementOf(*planar)};
}

bool isIncrement(const std::string& kind) { return kind.rfind("CActionRobotMovement", 0) == 0; }
}  // namespace

bool OdometryReader::accept(const std::string& kind)
{
  if (std::find(kinds_.begin(), kinds_.end(), kind) == kinds_.end()) kinds_.push_back(kind);
  if (kind_.empty()) kind_ = kind;
  // Motions of both classes continue the same chain of poses.
  if (kind_ == kind || (isIncrement(kind_) && isIncrement(kind))) return true;
  ignoredKind_ = kind;
  return false;
}

std::vector<StrayRecord> OdometryReader::read(
    std::size_t record, const mrpt::obs::CObservation& observation)
{
  using mrpt::obs::CObservationOdometry;
  using mrpt::obs::CObservationRobotPose;
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation))
  {
    if (!accept("CObservationOdometry " + odometry->sensorLabel)) return {};
    const CPose3DPDFGaussian pose(mrpt::poses::CPose3D(odometry->odometry));
    return odometry_.add({timeOfRecord(*odometry), pose, record});
  }
  const auto* pose = dynamic_cast<const CObservationRobotPose*>(&observation);
  if (!pose) return {};
  if (pose->sensorLabel == kGroundTruthLabel)
    return truth_.add({timeOfRecord(*pose), CPose3DPDFGaussian(pose->pose.mean), record});
  if (!accept("CObservationRobotPose " + pose->sensorLabel)) return {};
  return odometry_.add({timeOfRecord(*pose), withFiniteCovariance(pose->pose), record});
}

void OdometryReader::read(const mrpt::obs::CActionCollection& actions)
{
  const auto movement = movementIn(actions);
  if (!movement || !(countsActions_ || accept(movement->kind))) return;
  countsActions_ = true;
  const CPose3DPDFGaussian increment = withFiniteCovariance(movement->increment);
  if (const auto why = whyUnusable(increment)) throw std::runtime_error("the movement " + *why);
  sumOfActions_ += increment;
}

void OdometryReader::forgetOlderThan(double age)
{
  odometry_.forgetBefore(odometry_.latest() - age);
  truth_.forgetBefore(truth_.latest() - age);
}

void OdometryReader::forgetBefore(double time)
{
  odometry_.forgetBefore(time);
  truth_.forgetBefore(time);
}

}  // namespace quadmap
