#include "cloud/BoxCandidates.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cloud/WallsBehind.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/surfaces/HorizontalTop.h"
#include "quadmap/surfaces/SurfaceTolerance.h"
#include "support/SupportEvidence.h"

namespace quadmap
{
namespace
{
/** Only every second (third, ...) row and column of a large box is looked at. The cells then lie as
 * close together on the object, in shares of its size, as those of a small box, and cost no more.
 */
int candidateStep(int cells)
{
  constexpr double kMaxCells = 4000;
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(cells / kMaxCells))));
}

/** The first multiple of `step` from `cell` on. Boxes that overlap therefore look at the same
 * cells. */
int firstOf(int cell, int step) { return (cell + step - 1) / step * step; }

ImageBox enlarged(const ImageBox& box, double share)
{
  const double dx = share * box.width() + 2.0, dy = share * box.height() + 2.0;
  return {box.x1 - dx, box.y1 - dy, box.x2 + dx, box.y2 + dy};
}

/** What hangs on a wall and the wall are all that is in the box. Where the rim of the one bleeds
 * into the other, or where the wall is bent, a point belongs to the nearer one. */
void dropNearerToWall(const Plane& wall, BoxCandidates& candidates)
{
  if (candidates.points.empty()) return;
  std::vector<double> before;
  for (const auto& p : candidates.points) before.push_back(wall.signedDistance(p));
  const double half = 0.5 * median(before);
  keepOnly(candidates, [&](std::size_t i) { return before[i] > half; });
}

}  // namespace

CandidateRule::CandidateRule(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const DepthCloud::CellRange& range,
    const PerceptionOptions& options) :
    cloud_(cloud), planes_(planes), task_(task), options_(options)
{
  if (task.support) support_ = &planes.plane(*task.support).plane;
  // Planes that are not the object's own reach beyond the box.
  for (const double share : planes.all.sharesWithin(range))
    reachesBeyond_.push_back(share < RoughObject::kOwnShare);
}

bool CandidateRule::isMaskedOut(int c, int r) const
{
  const auto& mask = task_.detection->mask;
  const auto stride = static_cast<unsigned>(cloud_.stride());
  return mask &&
         !mask->contains(static_cast<unsigned>(c) * stride, static_cast<unsigned>(r) * stride);
}

bool CandidateRule::isAboveTop(const Eigen::Vector3d& p) const
{
  if (!top_) return false;
  const double perDepth = std::abs(top_->n.dot(p)) / p.z();
  return top_->signedDistance(p) > topTolerance(p.z(), perDepth, options_);
}

bool CandidateRule::isBackground(int c, int r, const Eigen::Vector3d& p) const
{
  if (support_ && support_->signedDistance(p) < supportTolerance(p.z(), task_.label, options_))
    return true;
  const double tolerance = options_.onPlane(p.z());
  if (isAboveTop(p)) return true;
  const int plane = planes_.all.planeAt(cloud_, c, r, tolerance);
  if (plane >= 0 && reachesBeyond(plane)) return true;
  return std::any_of(
      walls_.begin(), walls_.end(),
      [&](const Plane& wall) { return std::abs(wall.signedDistance(p)) < tolerance; });
}

BoxCandidates candidatesIn(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const PerceptionOptions& options)
{
  const ImageBox box = enlarged(task.detection->box, options.boxMargin);
  const auto range = cloud.cellsOf(box);
  BoxCandidates out = {
      {cloud, planes, task, range, options},
      range, candidateStep(range.cells())
  };
  const auto atMost = static_cast<std::size_t>(range.cells() / (out.step * out.step));
  out.cells.reserve(atMost);
  out.points.reserve(atMost);
  for (int r = firstOf(range.r0, out.step); r < range.r1; r += out.step)
    for (int c = firstOf(range.c0, out.step); c < range.c1; c += out.step)
      if (const auto p = out.rule.candidate(c, r))
      {
        out.cells.push_back({c, r});
        out.points.push_back(*p);
      }
  dropWallsBehind(cloud, planes, box, options, out);
  if (task.wall) dropNearerToWall(planes.plane(*task.wall).plane, out);
  if (task.label.levelTop)
  {
    const Plane* support = task.support ? &planes.plane(*task.support).plane : nullptr;
    if (const auto top =
            horizontalTop(cloud, out.points, out.step, support, planes.up, task.label, options))
    {
      out.rule.setTop(*top);
      keepOnly(out, [&](std::size_t i) { return !out.rule.isAboveTop(out.points[i]); });
    }
  }
  return out;
}

}  // namespace quadmap
