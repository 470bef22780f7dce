#pragma once

namespace quadmap
{
/** Standard deviation of the depths of a camera, equation (4.1). By default that of a
 * structured-light camera, after Nguyen, Izadi, Lovell, 3DIMPVT 2012. */
struct DepthNoise
{
  static constexpr double kGrowsFrom = 0.4;  //!< [m]

  double floor = 0.0012;   //!< Standard deviation up to kGrowsFrom [m], > 0
  double growth = 0.0019;  //!< Its growth with (z - kGrowsFrom)^2 [1/m], >= 0

  double sigma(double z) const  //!< [m]
  {
    const double far = z > kGrowsFrom ? z - kGrowsFrom : 0.0;
    return floor + growth * far * far;
  }
  DepthNoise times(double factor) const { return {factor * floor, factor * growth}; }
};

}  // namespace quadmap
