#include "Footprint.h"

#include <algorithm>
#include <limits>

#include "quadmap/geometry/ConvexHull.h"

namespace quadmap
{
namespace
{
/** Calls `use` with each side of a polygon, from corner to corner. */
template <typename F>
void forEachSide(const Footprint& polygon, F&& use)
{
  for (std::size_t i = 0; i < polygon.size(); ++i)
    use(polygon[i], polygon[(i + 1) % polygon.size()]);
}

/** The part of a polygon that lies to the left of the line from a to b. */
Footprint leftOf(const Footprint& polygon, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  Footprint kept;
  forEachSide(
      polygon,
      [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to)
      {
        const double atFrom = cross(b - a, from - a), atTo = cross(b - a, to - a);
        if (atFrom >= 0) kept.push_back(from);
        if ((atFrom > 0 && atTo < 0) || (atFrom < 0 && atTo > 0))
          kept.push_back(from + atFrom / (atFrom - atTo) * (to - from));
      });
  return kept;
}

Footprint intersectionOf(const Footprint& a, const Footprint& b)
{
  Footprint common = a;
  forEachSide(
      b, [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to)
      { common = leftOf(common, from, to); });
  return common;
}

double distanceToSide(
    const Eigen::Vector2d& p, const Eigen::Vector2d& from, const Eigen::Vector2d& to)
{
  const Eigen::Vector2d side = to - from;
  const double along = std::clamp((p - from).dot(side) / side.squaredNorm(), 0.0, 1.0);
  return (p - from - along * side).norm();
}

}  // namespace

double areaOf(const Footprint& polygon)
{
  double twice = 0;
  forEachSide(polygon, [&](const auto& from, const auto& to) { twice += cross(from, to); });
  return 0.5 * twice;
}

double sharedArea(const Footprint& a, const Footprint& b) { return areaOf(intersectionOf(a, b)); }

double distanceBetween(const Footprint& a, const Footprint& b)
{
  if (!intersectionOf(a, b).empty()) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const auto* polygon : {&a, &b})
    for (const Eigen::Vector2d& corner : *polygon)
      forEachSide(
          polygon == &a ? b : a, [&](const auto& from, const auto& to)
          { least = std::min(least, distanceToSide(corner, from, to)); });
  return least;
}

}  // namespace quadmap
