#include "quadmap/slam/PoseUncertainty.h"

#include <mrpt/poses/Lie/SO.h>

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
