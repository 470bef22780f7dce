#include "quadmap/geometry/ConvexHull.h"

#include <algorithm>

namespace quadmap
{
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points)
{
  std::sort(
      points.begin(), points.end(),
      [](const auto& a, const auto& b)
      { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Eigen::Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass)
  {
    const std::size_t start = hull.size();
    for (const auto& p : points)
    {
      while (hull.size() >= start + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // the first one of the other pass
    std::reverse(points.begin(), points.end());
  }
  if (hull.empty()) hull.push_back(points.front());
  return hull;
}

}  // namespace quadmap
