#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <optional>
#include <string>

#include "quadmap/base/OptionGroup.h"
#include "quadmap/odometry/PoseSource.h"

namespace quadmap
{
/** How much given poses are trusted: section [poses] of the configuration. A step of odometry over
 * d metres and a radians has these standard deviations (doc/mathematics.md, (15.1)):
 *   position  sigmaPosition + sigmaPositionPerMetre * d
 *   angles    sigmaAngle + sigmaAnglePerRadian * a + sigmaAnglePerMetre * d */
struct PoseUncertaintyOptions : public OptionGroup
{
  double sigmaPosition = 0.005;           //!< [m], > 0
  double sigmaAngle = fromDegrees(0.3L);  //!< [rad], > 0; INI in degrees
  double sigmaPositionPerMetre = 0.02;    //!< [m/m], >= 0
  double sigmaAnglePerRadian = 0.02;      //!< [rad/rad], >= 0
  double sigmaAnglePerMetre = 0.01;       //!< [rad/m], >= 0

 private:
  void describe(OptionList& list) override;
};

/** The relative pose T_from_to between two given poses, with the covariance of the step. */
mrpt::poses::CPose3DPDFGaussian odometryStep(
    const PoseUncertaintyOptions& options,
    const mrpt::poses::CPose3D& T_map_from,
    const mrpt::poses::CPose3D& T_map_to);

/** The step between poses whose source states their covariance (x, y, z, yaw, pitch, roll):
 * doc/mathematics.md, (15.2). When the covariance grows from `from` to `to` as that of summed steps
 * does, or from `to` to `from` in a step back in time, the step has what was added. Otherwise the
 * errors of the two poses are independent. The options give the variance of coordinates for which
 * the source states none (variance 0). */
mrpt::poses::CPose3DPDFGaussian odometryStep(
    const PoseUncertaintyOptions& options,
    const mrpt::poses::CPose3DPDFGaussian& from_map,
    const mrpt::poses::CPose3DPDFGaussian& to_map);

/** The step between two true poses, whose errors are independent. They are as large as the constant
 * part of the options. */
mrpt::poses::CPose3DPDFGaussian groundTruthStep(
    const PoseUncertaintyOptions& options,
    const mrpt::poses::CPose3D& T_map_from,
    const mrpt::poses::CPose3D& T_map_to);

/** Gives each pose of a trajectory its covariance, one pose after the other. */
class PoseCovarianceChain
{
 public:
  /** Errors of odometry add up from the first pose, which is exact because it defines the map. True
   *  poses are all equally good. */
  PoseCovarianceChain(const PoseUncertaintyOptions& options, PoseSource source);

  mrpt::poses::CPose3DPDFGaussian next(const mrpt::poses::CPose3D& T_map_robot);

 private:
  PoseUncertaintyOptions options_;
  PoseSource source_;
  std::optional<mrpt::poses::CPose3DPDFGaussian> last_;
};

}  // namespace quadmap
