#pragma once

#include "quadmap/base/OptionGroup.h"
#include "quadmap/surfaces/DepthNoise.h"

namespace quadmap
{
/** Which depth is trusted, and what is a plane. A part of section [perception] of the
 * configuration. */
struct SurfaceOptions : public OptionGroup
{
  double minRange = 0.3;  //!< Nearer depth is not trusted [m], > 0
  double maxRange = 6.0;  //!< Farther depth is too noisy for shapes [m], > minRange

  DepthNoise depthNoise;  //!< INI `depthSigmaFloor`, `depthSigmaGrowth`
  /** Each image tells by which factor its noise is larger, up to this one, >= 1; 1: it is as said.
   * 4 is what stereo has at a range; an image of clutter alone seems to have more. */
  double maxDepthNoiseFactor = 4;

  double planeMinArea = 0.008;  //!< Smallest plane worth a support, share of the image, in (0, 1)
  double planeMaxTilt = 0.17;   //!< A horizontal plane's normal to up [rad]; INI `planeMaxTilt_deg`
  double planeTolerance = 0.015;  //!< A point this near to its support belongs to it [m], > 0

  /** Of a point at a depth that may lie on a known plane [m]. */
  double onPlane(double z) const { return 0.5 * planeTolerance + 2.0 * depthSigma(z); }

  /** Standard deviation of a depth [m]. */
  double depthSigma(double z) const { return depthNoise.sigma(z); }

 protected:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
