#include "quadmap/geometry/HeadingHistogram.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
constexpr int kBins = 90;  // one degree each
constexpr double kPeriod = M_PI / 2;
constexpr double kBinWidth = kPeriod / kBins;
constexpr double kPeakHalfWidth = 10.0 * M_PI / 180.0;

double withinQuarterTurn(double yaw)
{
  const double folded = std::fmod(yaw, kPeriod);
  return folded < 0 ? folded + kPeriod : folded;
}

std::vector<double> smoothed(const std::vector<double>& bins)
{
  constexpr double kKernel[] = {0.06, 0.12, 0.20, 0.24, 0.20, 0.12, 0.06};
  std::vector<double> out(bins.size(), 0.0);
  for (int i = 0; i < kBins; ++i)
    for (int k = -3; k <= 3; ++k)
      out[static_cast<std::size_t>(i)] +=
          kKernel[k + 3] * bins[static_cast<std::size_t>((i + k + kBins) % kBins)];
  return out;
}

}  // namespace

HeadingHistogram::HeadingHistogram() : bins_(kBins, 0.0) {}

void HeadingHistogram::add(double heading, double weight)
{
  const double yaw = withinQuarterTurn(heading);
  const int bin = std::min(kBins - 1, static_cast<int>(yaw / kBinWidth));
  bins_[static_cast<std::size_t>(bin)] += weight;
  entries_.push_back({yaw, weight});
}

HeadingHistogram::Peak HeadingHistogram::peak() const
{
  Peak out;
  const auto smooth = smoothed(bins_);
  const auto highest = std::max_element(smooth.begin(), smooth.end());
  const double coarse = (static_cast<double>(highest - smooth.begin()) + 0.5) * kBinWidth;

  double inside = 0, offset = 0, squares = 0;
  for (const auto& entry : entries_)
  {
    out.mass += entry.weight;
    double apart = entry.yaw - coarse;  // both are folded: less than a period
    if (std::abs(apart) > kPeriod / 2) apart -= std::copysign(kPeriod, apart);
    if (std::abs(apart) > kPeakHalfWidth) continue;
    inside += entry.weight;
    offset += entry.weight * apart;
    squares += entry.weight * apart * apart;
  }
  if (inside > 0)
  {
    const double mean = offset / inside;
    out.yaw = withinQuarterTurn(coarse + mean);
    out.width = std::sqrt(std::max(0.0, squares / inside - mean * mean));
  }
  if (out.mass > 0) out.dominance = inside / out.mass;
  return out;
}

}  // namespace quadmap
