#include "SupportChoice.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
/** How the cells in and around a box lie with respect to one plane, as shares. */
struct Relation
{
  double ringOn = 0;       // of the ring around the lower half: on the plane
  double insideAbove = 0;  // of the inside: clearly above
  double insideBelow = 0;  // of the inside: clearly below
};

/** Down in the image at the middle of a box; a camera may be mounted any way round. */
Eigen::Vector2d downInImage(
    const PinholeCamera& camera, const Eigen::Vector3d& up, const ImageBox& box)
{
  const Eigen::Vector3d ray = camera.ray(box.centerX(), box.centerY());
  const Eigen::Vector2d down(
      camera.fx * (ray.x() * up.z() - up.x()), camera.fy * (ray.y() * up.z() - up.y()));
  return down.norm() > 0 ? down.normalized() : Eigen::Vector2d::UnitY();
}

Relation relate(
    const DepthCloud& cloud,
    const Plane& plane,
    const ImageBox& box,
    const Eigen::Vector3d& up,
    const PerceptionOptions& options)
{
  const double reach = std::max(6.0, 0.12 * std::max(box.width(), box.height()));  // [px]
  const auto inner = cloud.cellsOf(box);
  const auto outer =
      cloud.cellsOf({box.x1 - reach, box.y1 - reach, box.x2 + reach, box.y2 + reach});
  const Eigen::Vector2d down = downInImage(cloud.camera(), up, box);
  const double halfHeight =
      0.5 * (std::abs(down.x()) * box.width() + std::abs(down.y()) * box.height());
  const auto depthBelowMiddle = [&](int c, int r)
  {
    return down.x() * (c * cloud.stride() - box.centerX()) +
           down.y() * (r * cloud.stride() - box.centerY());
  };
  // The lowest tenth of the box shows the support as often as the object.
  const auto isCore = [&](int c, int r)
  { return inner.contains(c, r) && depthBelowMiddle(c, r) < 0.8 * halfHeight; };

  int ring = 0, ringOn = 0, inside = 0, above = 0, below = 0;
  const auto count = [&](int c, int r)
  {
    if (!cloud.valid(c, r)) return;
    const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
    const double distance = plane.signedDistance(p);
    const double tolerance = options.planeTolerance + 2.5 * options.depthSigma(p.z());
    if (isCore(c, r))
    {
      ++inside;
      if (distance > tolerance) ++above;
      if (distance < -2.0 * tolerance) ++below;
    }
    else
    {
      ++ring;
      if (std::abs(distance) < tolerance) ++ringOn;
    }
  };
  for (int r = outer.r0; r < outer.r1; r += 2)
    for (int c = outer.c0; c < outer.c1; c += 2)
      if (isCore(c, r) || depthBelowMiddle(c, r) >= 0) count(c, r);

  const auto share = [](int part, int all) { return all > 0 ? double(part) / all : 0.0; };
  return {share(ringOn, ring), share(above, inside), share(below, inside)};
}

/** Which horizontal plane an object stands on: for classes that stand on the floor the floor, for
 * others the plane that surrounds the lower part of the box and that the object rises above. */
std::optional<int> chooseSupport(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    UsualSupport usual,
    const PerceptionOptions& options)
{
  constexpr double kMinRing = 0.15, kMinAbove = 0.15, kMaxBelow = 0.35;
  if (usual == UsualSupport::Wall) return {};
  if (usual == UsualSupport::Floor) return planes.floor;

  std::optional<int> best;
  double bestScore = 0;
  for (const int i : planes.horizontal)
  {
    const Relation relation = relate(cloud, planes.plane(i).plane, box, planes.up, options);
    if (relation.ringOn < kMinRing || relation.insideAbove < kMinAbove) continue;
    if (relation.insideBelow > kMaxBelow) continue;
    const double score = relation.ringOn * (1.0 - relation.insideBelow);
    if (score > bestScore)
    {
      bestScore = score;
      best = i;
    }
  }
  return best;
}

}  // namespace

std::vector<BoxSupport> chooseSupports(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const std::vector<DetectedObject>& boxes,
    const LabelTable& labels,
    const PerceptionOptions& options)
{
  std::vector<BoxSupport> out;
  for (const auto& detection : boxes)
    out.push_back(
        {chooseSupport(
             cloud, planes, detection.box, labels.properties(detection.label).support, options),
         {},
         {}});
  return out;
}

}  // namespace quadmap
