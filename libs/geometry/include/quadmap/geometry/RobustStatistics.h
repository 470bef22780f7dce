#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace quadmap
{
/** p-quantile (0 <= p <= 1, linear interpolation) of the finite values.
 * \exception std::invalid_argument If there is no finite value or p is out of range. */
double quantile(std::vector<double> values, double p);

/** The p-quantile and the (1 - p)-quantile, p < 0.5. */
struct QuantileRange
{
  double low, high;
  double width() const { return high - low; }
};
QuantileRange quantileRange(std::vector<double> values, double p);

double median(std::vector<double> values);

/** The median as one of the values, of an even number the upper one: for what means nothing between
 * two values, as a depth between an edge and what is behind it.
 * \param values At least one; they are put into another order. */
template <typename T>
T medianElement(std::vector<T>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Standard deviation estimated as 1.4826 times the median absolute deviation. */
double madSigma(const std::vector<double>& values);

}  // namespace quadmap
