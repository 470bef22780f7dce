#pragma once

#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <optional>
#include <string>

#include "quadmap/slam/SlamOptions.h"

namespace quadmap
{
/** How much given poses are trusted. Section [poses] of the configuration. A step of odometry over
 * d metres and a radians has the standard deviations
 *   position  sigmaPosition + sigmaPositionPerMetre * d
 *   angles    sigmaAngle + sigmaAnglePerRadian * a + sigmaAnglePerMetre * d */
struct PoseUncertaintyOptions : public mrpt::config::CLoadableOptions
{
  double sigmaPosition = 0.005;            //!< [m], > 0
  double sigmaAngle = mrpt::DEG2RAD(0.3);  //!< [rad], > 0; INI in degrees
  double sigmaPositionPerMetre = 0.02;     //!< [m/m], >= 0
  double sigmaAnglePerRadian = 0.02;       //!< [rad/rad], >= 0
  double sigmaAnglePerMetre = 0.01;        //!< [rad/m], >= 0

  void loadFromConfigFile(
      const mrpt::config::CConfigFileBase& config, const std::string& section) override;
  void saveToConfigFile(
      mrpt::config::CConfigFileBase& config, const std::string& section) const override;
};

/** The relative pose T_from_to between two given poses, with the covariance of the step. */
mrpt::poses::CPose3DPDFGaussian odometryStep(
    const PoseUncertaintyOptions& options,
    const mrpt::poses::CPose3D& T_map_from,
    const mrpt::poses::CPose3D& T_map_to);

/** The same from poses whose source states their covariance, (x, y, z, yaw, pitch, roll). When the
 * covariance grows from `from` to `to` as that of summed increments does, the step is what was
 * added; else the two poses err independently of each other. A coordinate that the source says
 * nothing about (variance 0), and all when it is silent, is as the options say. */
mrpt::poses::CPose3DPDFGaussian odometryStep(
    const PoseUncertaintyOptions& options,
    const mrpt::poses::CPose3DPDFGaussian& from_map,
    const mrpt::poses::CPose3DPDFGaussian& to_map);

/** Between two ground truth poses, which err independently by the fixed part of the options. */
mrpt::poses::CPose3DPDFGaussian groundTruthStep(
    const PoseUncertaintyOptions& options,
    const mrpt::poses::CPose3D& T_map_from,
    const mrpt::poses::CPose3D& T_map_to);

/** Gives the poses of a trajectory, one after the other, their covariance. */
class PoseCovarianceChain
{
 public:
  /** With odometry errors add up from the first pose, which is exact because it defines the map;
   *  ground truth poses are all equally good. */
  PoseCovarianceChain(const PoseUncertaintyOptions& options, PoseSource source);

  mrpt::poses::CPose3DPDFGaussian next(const mrpt::poses::CPose3D& T_map_robot);

 private:
  PoseUncertaintyOptions options_;
  PoseSource source_;
  std::optional<mrpt::poses::CPose3DPDFGaussian> last_;
};

}  // namespace quadmap
