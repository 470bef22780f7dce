#include "quadmap/geometry/RobustStatistics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quadmap
{
double quantile(std::vector<double> values, double p)
{
  if (!(p >= 0 && p <= 1)) throw std::invalid_argument("quantile: p must be in [0, 1]");
  values.erase(
      std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }),
      values.end());
  if (values.empty()) throw std::invalid_argument("quantile: no finite value");

  const double position = p * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(position);
  std::nth_element(values.begin(), below, values.end());
  const double fraction = position - std::floor(position);
  if (fraction == 0) return *below;
  const double above = *std::min_element(below + 1, values.end());
  return *below + fraction * (above - *below);
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
