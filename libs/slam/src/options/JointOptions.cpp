#include "quadmap/slam/JointOptions.h"

#include "quadmap/base/OptionList.h"

namespace quadmap
{
void JointOptions::describe(OptionList& list)
{
  list.about("How poses and objects are estimated together, when the poses come from odometry.");
  list.flag(
      "correctPoses", correctPoses, "False takes the poses as given, whatever the objects say.");
  list.integer(
      "window", window, {2, 10000}, "",
      "Number of the latest keyframes that are estimated while running.");
  list.integer(
      "rounds", rounds, {0, 100}, "", "Most rounds of association and optimisation at the end.");
  list.number(
      "smallMove", smallMove, {1e-6, 10}, "m",
      "The rounds end when no keyframe moved farther than this.");
  list.number(
      "claimWeight", claimWeight, {1e-3, 1e12}, "",
      "The noise that odometry claims counts as much as this number of residuals of its steps, "
      "which tell in the run whether it is more or less. 1e12 believes the claim.");
  list.integer(
      "maxIterations", maxIterations, {1, 1000}, "", "Most iterations of one optimisation.");
  list.angle(
      "tiltSigma_deg", tiltSigma, {0, 90},
      "Standard deviation of the normal of what an object stands on. 0 does not use the normal.");
  list.angle(
      "upSigma_deg", upSigma, {0, 90},
      "How far off the first pose of visual odometry may be in what is up. 0 takes it as right.");
  list.number(
      "floorSigma", floorSigma, {0, 10}, "m",
      "Standard deviation of the bottom of things that stand on the floor. 0 does not use the "
      "floor.");
}

}  // namespace quadmap
