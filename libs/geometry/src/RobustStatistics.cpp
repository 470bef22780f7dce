#include "quadmap/geometry/RobustStatistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace quadmap
{
namespace
{
void dropInfinite(std::vector<double>& values)
{
  values.erase(
      std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }),
      values.end());
  if (values.empty()) throw std::invalid_argument("quantile: no finite value");
}

/** \param values Finite, at least one; put into another order. */
double quantileOf(std::vector<double>& values, double p)
{
  if (!(p >= 0 && p <= 1)) throw std::invalid_argument("quantile: p must be in [0, 1]");
  const double position = p * static_cast<double>(values.size() - 1);
  const auto rank = static_cast<std::size_t>(position);
  const double fraction = position - static_cast<double>(rank);
  // Far out few values need to be looked at twice.
  constexpr std::size_t kTail = 32;
  if (values.size() - rank <= values.size() / kTail)
  {
    std::vector<double> highest(values.size() - rank);
    std::partial_sort_copy(
        values.begin(), values.end(), highest.begin(), highest.end(), std::greater<double>());
    const double value = highest.back();
    return fraction == 0 ? value : value + fraction * (highest[highest.size() - 2] - value);
  }
  if (rank + 2 <= values.size() / kTail)
  {
    std::vector<double> lowest(rank + 2);
    std::partial_sort_copy(values.begin(), values.end(), lowest.begin(), lowest.end());
    return fraction == 0 ? lowest[rank]
                         : lowest[rank] + fraction * (lowest[rank + 1] - lowest[rank]);
  }
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), below, values.end());
  if (fraction == 0) return *below;
  const double above = *std::min_element(below + 1, values.end());
  return *below + fraction * (above - *below);
}

}  // namespace

double quantile(std::vector<double> values, double p)
{
  dropInfinite(values);
  return quantileOf(values, p);
}

QuantileRange quantileRange(std::vector<double> values, double p)
{
  dropInfinite(values);
  return {quantileOf(values, p), quantileOf(values, 1 - p)};
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

double madSigma(const std::vector<double>& values)
{
  const double center = median(values);
  std::vector<double> deviations;
  deviations.reserve(values.size());
  for (double v : values) deviations.push_back(std::abs(v - center));
  return 1.4826 * median(std::move(deviations));
}

double huberWeight(double normalisedResidual, double threshold)
{
  const double size = std::abs(normalisedResidual);
  return size <= threshold ? 1.0 : threshold / size;
}

}  // namespace quadmap
