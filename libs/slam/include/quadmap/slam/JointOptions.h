#pragma once

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** How poses and objects are estimated together. Section [joint] of the configuration. */
struct JointOptions : public OptionGroup
{
  bool correctPoses = true;  //!< False: poses are taken as given, whatever objects say
  int window = 20;           //!< Latest keyframes that are estimated while running, >= 2
  int rounds = 5;            //!< Of association and optimisation at the end, at most, >= 0
  double smallMove = 0.002;  //!< The rounds end when no keyframe moved farther [m], > 0
  /** What the odometry claims to err by counts as much as this number of residuals of its steps;
   * these tell in the run whether it is more or less. Large: the claim is believed. > 0. */
  double claimWeight = 20;
  int maxIterations = 30;  //!< Of one optimisation, >= 1

  double tiltSigma = fromDegrees(1.0L);  //!< Of a support's normal [rad]; INI in degrees; 0: unused
  /** How far off the first pose of visual odometry may be in what is up [rad], >= 0; the normals of
   * what objects stand on then correct it instead of bending the trajectory. INI in degrees; 0: it
   * is right. */
  double upSigma = fromDegrees(2.0L);
  double floorSigma = 0.02;  //!< Bottom of things that stand on the floor [m]; 0: unused

 private:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
