#pragma once

#include <algorithm>
#include <cmath>

namespace quadmap
{
/** A residual r [sigmas] as it enters the sum of squares, and its derivative by r:
 * 1/2 value^2 = weight * Huber's cost of r. */
struct HuberRow
{
  double value, slope;
};

inline HuberRow huberRow(double r, double huber, double weight)
{
  const double root = std::sqrt(weight), size = std::abs(r);
  if (size <= huber) return {root * r, root};
  const double value = std::sqrt(huber * (2 * size - huber));
  return {root * std::copysign(value, r), root * huber / value};
}

}  // namespace quadmap
