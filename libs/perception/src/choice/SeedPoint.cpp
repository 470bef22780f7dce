#include "choice/SeedPoint.h"

#include <algorithm>
#include <vector>

#include "cloud/BoxSurroundings.h"
#include "cloud/Precision.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
/** What returns depth in more of its box is no screen: what lacks it there are shadows of edges. */
constexpr double kMaxScreenCoverage = 0.5;

/** The depths in a box but not in its hole [m], and their rays, points of depth 1: on the plane
 * n . p = 1 a ray's inverse depth is n . ray. */
struct DepthsIn
{
  std::vector<Eigen::Vector3d> rays;
  std::vector<double> depths;

  DepthsIn(const DepthCloud& cloud, const ImageBox& box, const ImageBox& hole)
  {
    const auto range = cloud.cellsOf(box), excluded = cloud.cellsOf(hole);
    for (int r = range.r0; r < range.r1; ++r)
      for (int c = range.c0; c < range.c1; ++c)
      {
        if (!cloud.valid(c, r) || excluded.contains(c, r)) continue;
        const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
        rays.emplace_back(p / p.z());
        depths.push_back(p.z());
      }
  }
  bool tellNothing() const { return depths.size() < kFewestCells; }
};

/** Depth on a ray of the one plane that all depths come from; nothing when there is more than one.
 */
std::optional<double> depthOnPlane(const DepthsIn& around, const Eigen::Vector3d& ray)
{
  constexpr double kFlat = 0.04;   // of the depth, what a plane's points may be off by ...
  constexpr double kShare = 0.85;  // ... but for these, things that stand beside
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < around.rays.size(); ++i)
  {
    A += around.rays[i] * around.rays[i].transpose();
    b += around.rays[i] / around.depths[i];
  }
  const Eigen::Vector3d n = A.ldlt().solve(b);
  std::vector<double> off;
  for (std::size_t i = 0; i < around.rays.size(); ++i)
    off.push_back(std::abs(around.depths[i] * n.dot(around.rays[i]) - 1));
  if (!n.allFinite() || quantile(std::move(off), kShare) > kFlat || n.dot(ray) <= 0) return {};
  return 1 / n.dot(ray);
}

/** A surface point for an object without cloud: the near part of the box's middle. What is without
 * depth there lies on the plane that surrounds it (a phone on a desk), or in a frame or on a stand
 * before what is behind. */
std::optional<Eigen::Vector3d> seedWithoutCloud(const DepthCloud& cloud, const ImageBox& box)
{
  const Eigen::Vector3d ray = cloud.camera().ray(box.centerX(), box.centerY());
  const double w = 0.25 * box.width(), h = 0.25 * box.height();
  const DepthsIn core(cloud, {box.x1 + w, box.y1 + h, box.x2 - w, box.y2 - h}, {});
  if (!core.tellNothing()) return Eigen::Vector3d(ray * quantile(core.depths, 0.3));

  const DepthsIn around(cloud, withSurroundings(box), box);
  if (around.tellNothing()) return {};
  const auto onPlane = depthOnPlane(around, ray);
  return Eigen::Vector3d(ray * (onPlane ? *onPlane : quantile(around.depths, 0.25)));
}

}  // namespace

bool looksLikeScreen(const ObjectCloud& object) { return object.coverage <= kMaxScreenCoverage; }

std::optional<Eigen::Vector3d> seedOf(
    const DepthCloud& cloud, const ImageBox& box, const ObjectCloud& object, bool isComplete)
{
  std::optional<Eigen::Vector3d> out;
  if (object.empty() || (looksLikeScreen(object) && !isComplete))
    out = seedWithoutCloud(cloud, box);
  if (!out && !object.empty())
    out = cloud.camera().ray(box.centerX(), box.centerY()) * median(sampleOf(object.points, 2));
  return out;
}

std::optional<double> nearDepthOf(
    const DepthCloud& cloud, const ImageBox& box, const ObjectCloud& object)
{
  if (!object.empty()) return quantile(sampleOf(object.points, 2), 0.05);
  const auto seed = seedWithoutCloud(cloud, box);
  if (!seed) return {};
  return seed->z();
}

}  // namespace quadmap
