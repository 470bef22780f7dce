#include "MeanAndSpread.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <numeric>

namespace quadmap
{
std::optional<double> MeanAndSpread::mean() const
{
  if (values_.empty()) return std::nullopt;
  return std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(count());
}

std::optional<double> MeanAndSpread::deviation() const
{
  if (count() < 2) return std::nullopt;
  const double center = *mean();
  double squares = 0;
  for (const double value : values_) squares += (value - center) * (value - center);
  return std::sqrt(squares / static_cast<double>(count() - 1));
}

std::string MeanAndSpread::text(int decimals) const
{
  if (values_.empty()) return "-";
  std::string text = mrpt::format("%.*f", decimals, *mean());
  if (const auto spread = deviation()) text += mrpt::format(" +- %.*f", decimals, *spread);
  return text;
}

}  // namespace quadmap
