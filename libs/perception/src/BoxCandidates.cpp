#include "BoxCandidates.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
ImageBox enlarged(const ImageBox& box, double share)
{
  const double dx = share * box.width() + 2.0, dy = share * box.height() + 2.0;
  return {box.x1 - dx, box.y1 - dy, box.x2 + dx, box.y2 + dy};
}

double planeTolerance(double z, const PerceptionOptions& options)
{
  return 0.5 * options.planeTolerance + 2.0 * options.depthSigma(z);
}

/** Vertical planes that much of the box's surroundings lies on: they go on behind the object, also
 * where the segmentation lost them. */
std::vector<Plane> wallsAround(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    const std::vector<double>& ownShares,
    double minOwnShare,
    const PerceptionOptions& options)
{
  constexpr double kMinShare = 0.15;  // of the surroundings; less may be a box beside the object
  constexpr double kRing = 0.15;      // width, of the box's size
  constexpr int kStep = 3;            // cells
  const double width = std::max(8.0, kRing * std::max(box.width(), box.height()));
  const auto outer =
      cloud.cellsOf({box.x1 - width, box.y1 - width, box.x2 + width, box.y2 + width});
  const auto inner = cloud.cellsOf(box);
  std::vector<int> counts(planes.vertical.size(), 0);
  int all = 0;
  for (int r = outer.r0; r < outer.r1; r += kStep)
    for (int c = outer.c0; c < outer.c1; c += kStep)
    {
      if (inner.contains(c, r) || !cloud.valid(c, r)) continue;
      ++all;
      const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
      for (std::size_t i = 0; i < counts.size(); ++i)
        counts[i] += std::abs(planes.plane(planes.vertical[i]).plane.signedDistance(p)) <
                     planeTolerance(p.z(), options);
    }
  std::vector<Plane> out;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (ownShares[static_cast<std::size_t>(planes.vertical[i])] < minOwnShare &&
        counts[i] > kMinShare * all)
      out.push_back(planes.plane(planes.vertical[i]).plane);
  return out;
}

}  // namespace

double supportTolerance(double z, const LabelProperties& label, const PerceptionOptions& options)
{
  const double allowed = std::min(options.planeTolerance, 0.25 * label.typicalSize.z());
  return std::max(allowed, 2.5 * options.depthSigma(z));
}

BoxCandidates candidatesIn(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const PerceptionOptions& options)
{
  BoxCandidates out;
  const ImageBox box = enlarged(task.detection->box, options.boxMargin);
  out.range = cloud.cellsOf(box);
  const auto ownShares = planes.all.sharesWithin(out.range);
  // Share of a plane inside the box that makes it the object's own; others reach beyond. What hangs
  // on a wall covers much of what is seen of it.
  const double minOwnShare = task.label.support == UsualSupport::Wall ? 0.85 : 0.5;
  const auto walls = wallsAround(cloud, planes, box, ownShares, minOwnShare, options);
  const auto& mask = task.detection->mask;
  const auto isBackground = [&](int c, int r, const Eigen::Vector3d& p)
  {
    if (task.support && planes.plane(*task.support).plane.signedDistance(p) <
                            supportTolerance(p.z(), task.label, options))
      return true;
    const double tolerance = planeTolerance(p.z(), options);
    for (const auto& wall : walls)
      if (std::abs(wall.signedDistance(p)) < tolerance) return true;
    const int plane = planes.all.planeAt(cloud, c, r, tolerance);
    return plane >= 0 && ownShares[static_cast<std::size_t>(plane)] < minOwnShare;
  };
  const auto stride = static_cast<unsigned>(cloud.stride());
  for (int r = out.range.r0; r < out.range.r1; ++r)
    for (int c = out.range.c0; c < out.range.c1; ++c)
    {
      if (!cloud.valid(c, r) || cloud.isFlyingPixel(c, r)) continue;
      if (mask &&
          !mask->contains(static_cast<unsigned>(c) * stride, static_cast<unsigned>(r) * stride))
        continue;
      const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
      if (isBackground(c, r, p)) continue;
      out.cells.push_back({c, r});
      out.points.push_back(p);
    }
  return out;
}

}  // namespace quadmap
