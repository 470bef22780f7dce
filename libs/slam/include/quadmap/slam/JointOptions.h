#pragma once

#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/core/bits_math.h>

namespace quadmap
{
/** How poses and objects are estimated together. Section [joint] of the configuration. */
struct JointOptions : public mrpt::config::CLoadableOptions
{
  bool correctPoses = true;  //!< False: poses are taken as given, whatever objects say
  int window = 20;           //!< Latest keyframes that are estimated while running, >= 2
  int rounds = 5;            //!< Of association and optimisation at the end, at most, >= 0
  double smallMove = 0.002;  //!< The rounds end when no keyframe moved farther [m], > 0
  int maxIterations = 30;    //!< Of one optimisation, >= 1

  double tiltSigma =
      mrpt::DEG2RAD(1.0);  //!< Of a support's normal [rad]; INI in degrees; 0: unused
  /** How far off the first pose of visual odometry may be in what is up [rad], >= 0; the normals of
   * what objects stand on then correct it instead of bending the trajectory. INI in degrees; 0: it
   * is right. */
  double upSigma = mrpt::DEG2RAD(2.0);
  double floorSigma = 0.02;  //!< Bottom of things that stand on the floor [m]; 0: unused

  void loadFromConfigFile(
      const mrpt::config::CConfigFileBase& config, const std::string& section) override;
  void saveToConfigFile(
      mrpt::config::CConfigFileBase& config, const std::string& section) const override;
};

}  // namespace quadmap
