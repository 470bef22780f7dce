#include "quadmap/surfaces/SurfaceOptions.h"

#include "quadmap/base/OptionList.h"

namespace quadmap
{
void SurfaceOptions::describe(OptionList& list)
{
  list.number("minRange", minRange, {1e-3, 100}, "m", "Nearer depth is not trusted.");
  list.number("maxRange", maxRange, {1e-3, 1000}, "m", "Farther depth is too noisy for shapes.");
  list.number(
      "depthSigmaFloor", depthNoise.floor, {1e-6, 1}, "m",
      "Depth noise at 0.4 m: sigma(z) = depthSigmaFloor + depthSigmaGrowth (z - 0.4 m)^2.");
  list.number(
      "depthSigmaGrowth", depthNoise.growth, {0, 1}, "1/m",
      "Growth of the depth noise in that equation.");
  list.number(
      "maxDepthNoiseFactor", maxDepthNoiseFactor, {1, 100}, "",
      "Each image tells by which factor, up to this one, its depth is noisier than that. 1: the "
      "equation holds as it is.");
  list.number(
      "planeMinArea", planeMinArea, {1e-5, 1}, "",
      "Smallest plane that may be a support, as a share of the image.");
  list.angle(
      "planeMaxTilt_deg", planeMaxTilt, {0.1, 45},
      "Largest angle between up and the normal of a horizontal plane.");
  list.number(
      "planeTolerance", planeTolerance, {1e-4, 1}, "m",
      "A point this near to its support belongs to it.");
  list.requireLess("minRange", "maxRange");
}

}  // namespace quadmap
