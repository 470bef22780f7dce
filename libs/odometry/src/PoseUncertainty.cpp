#include "quadmap/odometry/PoseUncertainty.h"

#include <mrpt/poses/Lie/SO.h>

#include <Eigen/Dense>
#include <algorithm>

#include "quadmap/base/OptionList.h"
#include "quadmap/geometry/StepCovariance.h"

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
/** Covariance of the step between two poses whose source states theirs. */
PoseCovariance statedCovariance(const CPose3DPDFGaussian& from, const CPose3DPDFGaussian& to)
{
  if (const auto added = addedCovariance(from, to)) return *added;
  // A camera whose images come late is behind the others. The step back undoes what was added.
  if (const auto added = addedCovariance(to, from))
  {
    CPose3DPDFGaussian back(from.mean - to.mean), step;
    back.cov = *added;
    back.inverse(step);
    return step.cov.asEigen();
  }
  return (to - from).cov.asEigen();
}

/** The covariance itself, when it is positive definite. Otherwise (it states large variances that
 * are fully correlated, say) the nearest one whose least variance rounding does not reach. */
PoseCovariance positiveDefinite(const PoseCovariance& P, double least)
{
  constexpr double kRounding = 1e-12;  // of the largest variance
  if (P.llt().info() == Eigen::Success) return P;
  const Eigen::SelfAdjointEigenSolver<PoseCovariance> eigen(P);
  const Eigen::Matrix<double, 6, 1> variances =
      eigen.eigenvalues().cwiseMax(std::max(least, kRounding * eigen.eigenvalues().maxCoeff()));
  return eigen.eigenvectors() * variances.asDiagonal() * eigen.eigenvectors().transpose();
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
  const PoseCovariance stated = statedCovariance(from, to);
  if (!stated.allFinite()) return step;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      if (stated(i, i) > kSilent && stated(j, j) > kSilent)
        step.cov(i, j) = stated(i, j) + (i == j ? kLeast : 0.0);
  step.cov = positiveDefinite(step.cov.asEigen(), kLeast);
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
