#include "cuboid/TopRim.h"

#include <algorithm>
#include <cmath>

#include "cloud/Precision.h"
#include "cuboid/FaceSigmas.h"
#include "cuboid/HeadingByLines.h"
#include "quadmap/geometry/DensestWindow.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
namespace
{
/** What a cell shows of a level top. */
enum class Shows
{
  Nothing,
  Top,
  Past,   // the ray passed the top's plane beyond its rim
  Before  // something above the plane hides what is there
};

/** Walks over the cells of an object and looks for the rim of its top. */
struct RimSearch
{
  const DepthCloud& cloud;
  const ObjectCloud& object;
  const Plane& top;  // optical frame
  const Eigen::Matrix3d& R_upright_optical;
  const PerceptionOptions& options;

  Shows shows(int c, int r) const
  {
    if (!cloud.valid(c, r)) return Shows::Nothing;
    const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
    const double height = top.signedDistance(p);
    const double tolerance = topTolerance(p.z(), std::abs(top.n.dot(p)) / p.z(), options);
    if (std::abs(height) > tolerance) return height < 0 ? Shows::Past : Shows::Before;
    return object.mask.contains(c, r) ? Shows::Top : Shows::Nothing;
  }

  /** Walks along rows and columns; the rim is where the top and what is past it meet. */
  std::vector<RimPoint> rim() const
  {
    std::vector<RimPoint> out;
    // What looks past the rim lies outside a tight box.
    const auto& box = object.inBox;
    const int c0 = std::max(0, box.c0 - kMixedCells - 1),
              r0 = std::max(0, box.r0 - kMixedCells - 1);
    const int c1 = std::min(cloud.columns(), box.c1 + kMixedCells + 1);
    const int r1 = std::min(cloud.rows(), box.r1 + kMixedCells + 1);
    constexpr int kLines = 200;  // are enough
    const int every = 1 + (r1 - r0 + c1 - c0) / kLines;
    for (int r = r0; r < r1; r += every) walk({c0, r}, {1, 0}, c1 - c0, out);
    for (int c = c0; c < c1; c += every) walk({c, r0}, {0, 1}, r1 - r0, out);
    return out;
  }

  using Cell = Eigen::Vector2i;  // column, row

  void walk(const Cell& first, const Cell& step, int count, std::vector<RimPoint>& out) const
  {
    int last = -1;  // that showed something
    Shows before = Shows::Nothing;
    for (int i = 0; i < count; ++i)
    {
      const Cell cell = first + i * step;
      const Shows now = shows(cell.x(), cell.y());
      if (now == Shows::Nothing) continue;
      const Cell previous = first + last * step;
      if (last >= 0 && i - last <= kMixedCells + 1)
      {
        if (before == Shows::Top && now == Shows::Past)
          out.push_back(rimPast(previous, step));
        else if (before == Shows::Past && now == Shows::Top)
          out.push_back(rimPast(cell, -step));
      }
      last = i;
      before = now;
    }
  }

  /** Equation (8.10). \param outwards Step to the next cell. */
  RimPoint rimPast(const Cell& onTop, const Cell& outwards) const
  {
    const Eigen::Vector2d out = onPlane(onTop + outwards) - onPlane(onTop);
    return {seenAt(onTop) + 0.5 * out, out};
  }
  Eigen::Vector2d seenAt(const Cell& cell) const
  {
    return (R_upright_optical * cloud.point(cell.x(), cell.y()).cast<double>()).head<2>();
  }
  Eigen::Vector2d onPlane(const Cell& cell) const
  {
    const Eigen::Vector3d ray =
        cloud.camera().ray(cell.x() * cloud.stride(), cell.y() * cloud.stride());
    return (R_upright_optical * (ray * (-top.d / top.n.dot(ray)))).head<2>();
  }
};

}  // namespace

TopRim::TopRim(
    const DepthCloud& cloud,
    const ObjectCloud& object,
    const Plane& top,
    const Eigen::Matrix3d& R_upright_optical,
    const PerceptionOptions& options) :
    rim_(RimSearch{cloud, object, top, R_upright_optical, options}.rim())
{
}

std::vector<RimPoint> TopRim::sidePoints(const Eigen::Vector2d& normal) const
{
  // Points of the rim that do not look past this side tell nothing of it.
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < rim_.size(); ++i)
    if (rim_[i].out.dot(normal) > kTurnedAway * rim_[i].out.norm())
      order.emplace_back(rim_[i].p.dot(normal), i);
  std::sort(order.begin(), order.end());
  std::vector<double> positions;
  for (const auto& o : order) positions.push_back(o.first);
  const Window window = densestWindow(positions, kEndWidth);
  std::vector<RimPoint> out;
  for (std::size_t i = 0; i < window.count; ++i)
    out.push_back(rim_[order[window.first + i].second]);
  return out;
}

std::optional<HeadingEstimate> TopRim::heading() const
{
  constexpr double kMinStraight = 0.6;
  if (rim_.size() < 2 * kFewestOfSurface) return {};
  const auto normalAt = [](double yaw) { return Eigen::Vector2d(std::cos(yaw), std::sin(yaw)); };
  const auto straight = [&](double yaw)
  {
    const Eigen::Vector2d x = normalAt(yaw), y(-x.y(), x.x());
    return sidePoints(x).size() + sidePoints(-x).size() + sidePoints(y).size() +
           sidePoints(-y).size();
  };
  HeadingEstimate out;
  std::size_t most = 0;
  for (int degree = 0; degree < 90; degree += kHeadingStep_deg)
    if (const std::size_t sum = straight(degree * M_PI / 180.0); sum > most)
    {
      most = sum;
      out.yaw = degree * M_PI / 180.0;
    }
  const auto lineOf = [&](double normal)
  {
    const Eigen::Vector2d n = normalAt(normal), t(-n.y(), n.x());
    std::vector<Eigen::Vector2d> points;
    for (const auto& q : sidePoints(n)) points.emplace_back(q.p.dot(t), q.p.dot(n));
    return fitLine(std::move(points), kEndWidth);
  };
  const auto heading = headingByLines(out.yaw, lineOf);
  if (!heading) return {};
  out.yaw = heading->yaw;
  out.sigma = std::sqrt(heading->variance);
  out.dominance = static_cast<double>(straight(out.yaw)) / static_cast<double>(rim_.size());
  out.defined = out.dominance >= kMinStraight;
  return out.defined ? std::optional(out) : std::nullopt;
}

std::optional<TopRim::Side> TopRim::side(const Eigen::Vector2d& normal) const
{
  const Eigen::Vector2d along(-normal.y(), normal.x());
  const auto points = sidePoints(normal);
  if (points.size() < kFewestOfSurface) return {};
  Side out;
  std::vector<double> positions, shifts;
  for (const auto& q : points)
  {
    positions.push_back(q.p.dot(normal));
    shifts.push_back(q.p.dot(along));
    out.perCell += std::abs(q.out.dot(normal)) / static_cast<double>(points.size());
  }
  out.position = median(positions);
  out.shift = median(shifts);
  return out;
}

}  // namespace quadmap
