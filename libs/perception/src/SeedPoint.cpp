#include "SeedPoint.h"

#include <algorithm>
#include <vector>

#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
std::optional<double> medianDepthIn(
    const DepthCloud& cloud, const ImageBox& box, const ImageBox& hole, double p)
{
  const auto range = cloud.cellsOf(box), excluded = cloud.cellsOf(hole);
  std::vector<double> depths;
  for (int r = range.r0; r < range.r1; ++r)
    for (int c = range.c0; c < range.c1; ++c)
      if (cloud.valid(c, r) && !excluded.contains(c, r)) depths.push_back(cloud.depth(c, r));
  constexpr std::size_t kMinCells = 12;
  if (depths.size() < kMinCells) return {};
  return quantile(std::move(depths), p);
}

}  // namespace

std::optional<Eigen::Vector3d> seedWithoutCloud(const DepthCloud& cloud, const ImageBox& box)
{
  const double w = 0.25 * box.width(), h = 0.25 * box.height();
  const ImageBox core = {box.x1 + w, box.y1 + h, box.x2 - w, box.y2 - h};
  const double ring = std::max(8.0, 0.1 * std::max(box.width(), box.height()));
  const ImageBox around = {box.x1 - ring, box.y1 - ring, box.x2 + ring, box.y2 + ring};
  auto depth = medianDepthIn(cloud, core, {}, 0.3);
  if (!depth) depth = medianDepthIn(cloud, around, box, 0.25);
  if (!depth) return {};
  return Eigen::Vector3d(cloud.camera().ray(box.centerX(), box.centerY()) * *depth);
}

Eigen::Vector3d seedOf(const ObjectCloud& object)
{
  Eigen::Vector3d out;
  for (int axis = 0; axis < 3; ++axis) out[axis] = median(sampleOf(object.points, axis));
  return out;
}

double nearDepthOf(const ObjectCloud& object) { return quantile(sampleOf(object.points, 2), 0.05); }

}  // namespace quadmap
