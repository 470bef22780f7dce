#include "quadmap/geometry/RobustStatistics.h"

#include <algorithm>
#include <cmath>
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

/** The p-quantile of finite values.
 * \param values At least one; they are put into another order.
 * \param known So many values at the start are known not to exceed any of the others. */
double quantileOf(std::vector<double>& values, double p, std::size_t known = 0)
{
  if (!(p >= 0 && p <= 1)) throw std::invalid_argument("quantile: p must be in [0, 1]");
  const double position = p * static_cast<double>(values.size() - 1);
  const auto rank = static_cast<std::size_t>(position);
  const double fraction = position - static_cast<double>(rank);
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(known), at(rank), values.end());
  if (fraction == 0) return values[rank];
  const double above = *std::min_element(at(rank + 1), values.end());
  return values[rank] + fraction * (above - values[rank]);
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
  const double low = quantileOf(values, p);
  const auto known = static_cast<std::size_t>(p * static_cast<double>(values.size() - 1));
  return {low, quantileOf(values, 1 - p, known)};
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

}  // namespace quadmap
