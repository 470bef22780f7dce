#pragma once

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** Which depth is trusted, and what is a plane. A part of section [perception] of the
 * configuration. */
struct SurfaceOptions : public OptionGroup
{
  double minRange = 0.3;  //!< Nearer depth is not trusted [m], > 0
  double maxRange = 6.0;  //!< Farther depth is too noisy for shapes [m], > minRange

  /** Depth noise of a structured-light camera, sigma(z) = floor + growth (z - 0.4 m)^2, after
   * Nguyen, Izadi, Lovell, 3DIMPVT 2012. */
  double depthSigmaFloor = 0.0012;                     //!< [m], > 0
  double depthSigmaGrowth = 0.0019;                    //!< [1/m], >= 0
  static constexpr double kDepthSigmaGrowsFrom = 0.4;  //!< [m]

  double planeMinArea = 0.008;  //!< Smallest plane worth a support, share of the image, in (0, 1)
  double planeMaxTilt = 0.17;   //!< A horizontal plane's normal to up [rad]; INI `planeMaxTilt_deg`
  double planeTolerance = 0.015;  //!< A point this near to its support belongs to it [m], > 0

  /** Of a point at a depth that may lie on a known plane [m]. */
  double onPlane(double z) const { return 0.5 * planeTolerance + 2.0 * depthSigma(z); }

  /** Standard deviation of a depth [m]. */
  double depthSigma(double z) const
  {
    const double far = z > kDepthSigmaGrowsFrom ? z - kDepthSigmaGrowsFrom : 0.0;
    return depthSigmaFloor + depthSigmaGrowth * far * far;
  }

 protected:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
