#pragma once

namespace quadmap
{
/** Metres of one step of a depth image that a sensor may have. The images have 16 bits: with
 * smaller units the farthest depth is below 7 mm, with larger ones the nearest beyond a metre. */
constexpr double kSmallestDepthUnit = 1e-7, kLargestDepthUnit = 1.0;  // [m]

/** False for NaN, too. A unit of a float need not be exact. */
constexpr bool isPlausibleDepthUnit(double unit)
{
  constexpr double kRounding = 1e-6;  // relative
  return unit >= kSmallestDepthUnit * (1 - kRounding) &&
         unit <= kLargestDepthUnit * (1 + kRounding);
}

}  // namespace quadmap
