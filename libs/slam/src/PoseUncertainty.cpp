#include "quadmap/slam/PoseUncertainty.h"

#include <mrpt/poses/Lie/SO.h>

#include <Eigen/Dense>

#include "OptionText.h"
#include "quadmap/obs/ConfigCheck.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

void PoseUncertaintyOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& config, const std::string& section)
{
  rejectUnknownKeys(
      config, section,
      {"sigmaPosition", "sigmaAngle_deg", "sigmaPositionPerMetre", "sigmaAnglePerRadian",
       "sigmaAnglePerMetre"});
  readNumber(config, section, "sigmaPosition", sigmaPosition, 1e-6, 10.0);
  double sigmaAngle_deg = mrpt::RAD2DEG(sigmaAngle);
  readNumber(config, section, "sigmaAngle_deg", sigmaAngle_deg, 1e-4, 180.0);
  sigmaAngle = mrpt::DEG2RAD(sigmaAngle_deg);
  readNumber(config, section, "sigmaPositionPerMetre", sigmaPositionPerMetre, 0.0, 10.0);
  readNumber(config, section, "sigmaAnglePerRadian", sigmaAnglePerRadian, 0.0, 10.0);
  readNumber(config, section, "sigmaAnglePerMetre", sigmaAnglePerMetre, 0.0, 10.0);
}

void PoseUncertaintyOptions::saveToConfigFile(
    mrpt::config::CConfigFileBase& config, const std::string& section) const
{
  config.write(section, "sigmaPosition", optionText(sigmaPosition));
  config.write(section, "sigmaAngle_deg", optionText(mrpt::RAD2DEG(sigmaAngle)));
  config.write(section, "sigmaPositionPerMetre", optionText(sigmaPositionPerMetre));
  config.write(section, "sigmaAnglePerRadian", optionText(sigmaAnglePerRadian));
  config.write(section, "sigmaAnglePerMetre", optionText(sigmaAnglePerMetre));
}

namespace
{
/** Covariance of (x, y, z, yaw, pitch, roll), the order of MRPT. */
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
/** Covariance of the step that turned the covariance of `from` into that of `to`:
 *    P_to = J_from P_from J_from^t + J_step Q J_step^t;
 * nothing when no covariance Q does. */
std::optional<Eigen::Matrix<double, 6, 6>> addedCovariance(
    const CPose3DPDFGaussian& from, const CPose3DPDFGaussian& to, const CPose3D& T_from_to)
{
  constexpr double kRounding = 1e-9;  // of the largest variance: sums of many steps
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
  constexpr double kSilent = 1e-14;  // [m^2], [rad^2]: less than any odometry can promise
  constexpr double kLeast = 1e-8;    // [m^2], [rad^2]: (0.1 mm)^2, so that it has an inverse
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
  last_->mean = T_map_robot;  // free of rounding
  return *last_;
}

}  // namespace quadmap
