#pragma once

#include <algorithm>
#include <cmath>

namespace quadmap
{
/** A residual r [sigmas] as it enters the sum of squares, and its derivative by r:
 * 1/2 value^2 = weight * robust cost of r. */
struct RobustRow
{
  double value, slope;
};

/** Huber's cost: beyond the threshold a straight line. */
inline RobustRow huberRow(double r, double huber, double weight)
{
  const double root = std::sqrt(weight), size = std::abs(r);
  if (size <= huber) return {root * r, root};
  const double value = std::sqrt(huber * (2 * size - huber));
  return {root * std::copysign(value, r), root * huber / value};
}

/** Cauchy's cost, 1/2 scale^2 ln(1 + r^2 / scale^2). */
inline RobustRow cauchyRow(double r, double scale, double weight)
{
  const double root = std::sqrt(weight), u = r * r / (scale * scale);
  if (u < 1e-20) return {root * r, root};  // 0 / 0 below
  const double value = scale * std::sqrt(std::log1p(u));
  return {root * value, root * r / ((1 + u) * value)};
}

}  // namespace quadmap
