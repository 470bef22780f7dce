#include "Background.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
/** Noise of a level surface reaches so high [m]: a depth camera that looks down by 25 degrees errs
 * by 2 cm along its rays at the largest range, hence by 1 cm in height, of which this is three. */
constexpr double kLow = 0.03;

}  // namespace

void Background::add(const std::vector<BackgroundPlane>& walls)
{
  planes_.insert(planes_.end(), walls.begin(), walls.end());
}

void Background::addSupport(
    const BackgroundPlane& support,
    const std::vector<NearPoint>& near,
    const std::vector<NearPoint>& candidates)
{
  planes_.push_back(support);
  support_ = support;
  // The sides of flat things are as low as the noise.
  constexpr std::ptrdiff_t kHighPart = 10;  // one of so many points lies higher
  const auto high = std::count_if(
      candidates.begin(), candidates.end(),
      [&](const NearPoint& point) { return support.height(point.position) > 2 * kLow; });
  if (kHighPart * high < static_cast<std::ptrdiff_t>(candidates.size())) return;
  const double clearance = clearanceOf(support);
  for (const NearPoint& point : near)
  {
    const double height = support.height(point.position);
    if (std::abs(height) <= clearance)
      columns_[squareOf(point.position)].support += point.weight;
    else if (height > 0 && height <= kLow)
      columns_[squareOf(point.position)].low += point.weight;
  }
}

bool Background::contains(const Eigen::Vector3d& p) const
{
  return isNoise(p) ||
         std::any_of(
             planes_.begin(), planes_.end(),
             [&](const BackgroundPlane& plane) { return plane.height(p) <= clearanceOf(plane); });
}

bool Background::isNoise(const Eigen::Vector3d& p) const
{
  if (columns_.empty() || support_.height(p) > kLow) return false;
  const auto column = columns_.find(squareOf(p));
  return column != columns_.end() && column->second.support >= column->second.low;
}

Background::Square Background::squareOf(const Eigen::Vector3d& p)
{
  constexpr double kSize = 0.01;  // [m]
  return {static_cast<int>(std::floor(p.x() / kSize)), static_cast<int>(std::floor(p.y() / kSize))};
}

double Background::clearanceOf(const BackgroundPlane& plane) const
{
  return std::clamp(3 * plane.spread, clearance_, 2 * clearance_);
}

}  // namespace quadmap
