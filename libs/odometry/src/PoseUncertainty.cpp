#include "quadmap/odometry/PoseUncertainty.h"

#include <mrpt/poses/Lie/SO.h>

#include <Eigen/Dense>

#include "quadmap/base/OptionList.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

void PoseUncertaintyOptions::describe(OptionList& list)
{
  list.about(
      "How far the given poses are trusted, as far as they do not say so themselves. This holds as "
      "odometry of the estimation, in pose-graph.graph, and in map.simplemap where nothing was "
      "estimated. A step of odometry over d metres and a radians has the standard deviations "
      "sigmaPosition + sigmaPositionPerMetre d of its position and sigmaAngle + "
      "sigmaAnglePerRadian a + sigmaAnglePerMetre d of its angles.");
  list.number(
      "sigmaPosition", sigmaPosition, {1e-6, 10}, "m",
      "Fixed part of the standard deviation of the position.");
  list.angle(
      "sigmaAngle_deg", sigmaAngle, {1e-4, 180},
      "Fixed part of the standard deviation of the angles.");
  list.number(
      "sigmaPositionPerMetre", sigmaPositionPerMetre, {0, 10}, "m/m",
      "Growth of the standard deviation of the position with the way.");
  list.number(
      "sigmaAnglePerRadian", sigmaAnglePerRadian, {0, 10}, "rad/rad",
      "Growth of the standard deviation of the angles with the turn.");
  list.number(
      "sigmaAnglePerMetre", sigmaAnglePerMetre, {0, 10}, "rad/m",
      "Growth of the standard deviation of the angles with the way.");
}

namespace
{
/** Covariance of (x, y, z, yaw, pitch, roll), in MRPT's order. */
mrpt::math::CMatrixDouble66 diagonalCovariance(double sigmaPosition, double sigmaAngle)
{
  mrpt::math::CMatrixDouble66 cov;
  for (int i = 0; i < 3; ++i)
  {
    cov(i, i) = sigmaPosition * sigmaPosition;
    cov(i + 3, i + 3) = sigmaAngle * sigmaAngle;
  }
  return cov;
}

}  // namespace

CPose3DPDFGaussian odometryStep(
    const PoseUncertaintyOptions& options, const CPose3D& T_map_from, const CPose3D& T_map_to)
{
  const CPose3D T_from_to = T_map_to - T_map_from;
  const double moved = T_from_to.norm();
  const double turned = mrpt::poses::Lie::SO<3>::log(T_from_to.getRotationMatrix()).norm();
  const double sigmaPosition = options.sigmaPosition + options.sigmaPositionPerMetre * moved;
  const double sigmaAngle = options.sigmaAngle + options.sigmaAnglePerRadian * turned +
                            options.sigmaAnglePerMetre * moved;
  return {T_from_to, diagonalCovariance(sigmaPosition, sigmaAngle)};
}

namespace
{
/** Covariance Q of the step that turned the covariance of `from` into that of `to`:
 *    P_to = J_from P_from J_from^t + J_step Q J_step^t
 * It is nothing when no covariance Q does so. doc/mathematics.md, (15.2). */
std::optional<Eigen::Matrix<double, 6, 6>> addedCovariance(
    const CPose3DPDFGaussian& from, const CPose3DPDFGaussian& to, const CPose3D& T_from_to)
{
  constexpr double kRounding = 1e-9;  // error of sums of many steps / largest variance
  mrpt::math::CMatrixDouble66 J_from, J_step;
  mrpt::poses::CPose3DPDF::jacobiansPoseComposition(from.mean, T_from_to, J_from, J_step);
  const Eigen::Matrix<double, 6, 6> J = J_from.asEigen();
  const Eigen::Matrix<double, 6, 6> added =
      to.cov.asEigen() - J * from.cov.asEigen() * J.transpose();
  const Eigen::Matrix<double, 6, 6> toStep = J_step.asEigen().inverse();
  const Eigen::Matrix<double, 6, 6> Q = toStep * added * toStep.transpose();
  if (!Q.allFinite()) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(Q);
  const double least = -kRounding * to.cov.asEigen().cwiseAbs().maxCoeff();
  if (eigen.eigenvalues().minCoeff() < least) return std::nullopt;
  return Eigen::Matrix<double, 6, 6>(
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
      eigen.eigenvectors().transpose());
}

}  // namespace

CPose3DPDFGaussian odometryStep(
    const PoseUncertaintyOptions& options,
    const CPose3DPDFGaussian& from,
    const CPose3DPDFGaussian& to)
{
  constexpr double kSilent = 1e-14;  // no odometry promises less [m^2], [rad^2]
  constexpr double kLeast = 1e-8;    // least variance, for an inverse [m^2], [rad^2]
  CPose3DPDFGaussian step = odometryStep(options, from.mean, to.mean);
  if (from.cov.asEigen().isZero() && to.cov.asEigen().isZero()) return step;
  const auto added = addedCovariance(from, to, step.mean);
  const Eigen::Matrix<double, 6, 6> stated = added ? *added : (to - from).cov.asEigen();
  if (!stated.allFinite()) return step;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      if (stated(i, i) > kSilent && stated(j, j) > kSilent)
        step.cov(i, j) = stated(i, j) + (i == j ? kLeast : 0.0);
  return step;
}

CPose3DPDFGaussian groundTruthStep(
    const PoseUncertaintyOptions& options, const CPose3D& T_map_from, const CPose3D& T_map_to)
{
  const auto cov = diagonalCovariance(options.sigmaPosition, options.sigmaAngle);
  CPose3DPDFGaussian step = CPose3DPDFGaussian(T_map_to, cov) - CPose3DPDFGaussian(T_map_from, cov);
  step.mean = T_map_to - T_map_from;
  return step;
}

PoseCovarianceChain::PoseCovarianceChain(const PoseUncertaintyOptions& options, PoseSource source) :
    options_(options), source_(source)
{
}

CPose3DPDFGaussian PoseCovarianceChain::next(const CPose3D& T_map_robot)
{
  if (source_ == PoseSource::GroundTruth)
    return {T_map_robot, diagonalCovariance(options_.sigmaPosition, options_.sigmaAngle)};
  if (!last_)
    last_.emplace(T_map_robot, mrpt::math::CMatrixDouble66());
  else
    *last_ += odometryStep(options_, last_->mean, T_map_robot);
  last_->mean = T_map_robot;  // the sum of steps would have errors of rounding
  return *last_;
}

}  // namespace quadmap
