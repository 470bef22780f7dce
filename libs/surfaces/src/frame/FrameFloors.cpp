#include "frame/FrameFloors.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace quadmap
{
namespace
{
constexpr double kSameFloorInFrame = 0.12;  // [m]; a table top is higher above the floor than this
constexpr double kMinFloorArea = 1.0;       // of one that ends [m^2]: a step or a seat is smaller

/** Does the frame show something under a surface, away from its rim? */
bool isHollow(const DepthCloud& cloud, const ScenePlane& surface, const SurfaceOptions& options)
{
  constexpr double kCell = 0.15;    // wider than the distance of samples [m]
  constexpr double kClearly = 0.1;  // below the surface [m], doc/mathematics.md, (5.5)
  constexpr int kMinPoints = 8;
  const Eigen::Vector3d e1 = surface.plane.n.unitOrthogonal(), e2 = surface.plane.n.cross(e1);
  const auto cellOf = [&](const Eigen::Vector3d& p)
  {
    return std::pair(
        static_cast<int>(std::floor(e1.dot(p) / kCell)),
        static_cast<int>(std::floor(e2.dot(p) / kCell)));
  };
  std::vector<std::pair<int, int>> cells;
  for (const auto& p : surface.samples) cells.push_back(cellOf(p));
  std::sort(cells.begin(), cells.end());
  const auto isWithin = [&](const std::pair<int, int>& cell)
  {
    for (int k = 0; k < 9; ++k)
      if (!std::binary_search(
              cells.begin(), cells.end(),
              std::pair(cell.first + (k + 4) % 3 - 1, cell.second + (k + 4) / 3 % 3 - 1)))
        return false;
    return true;
  };
  int points = 0;
  for (const auto& p : cloud.sparsePoints())
    if (surface.plane.signedDistance(p) < -kClearly - options.onPlane(p.z()) &&
        isWithin(cellOf(p)) && ++points == kMinPoints)
      return true;
  return false;
}

/** The planes of the frame at the height of the known floor. */
std::vector<ScenePlane*> atFloor(ScenePlanes& planes, const Plane& known)
{
  std::vector<ScenePlane*> out;
  for (const int i : planes.horizontal)
  {
    ScenePlane& plane = planes.all.planes[static_cast<std::size_t>(i)];
    if (std::abs(known.signedDistance(plane.centroid)) < kSameFloorInFrame) out.push_back(&plane);
  }
  return out;
}

}  // namespace

double shareBelow(const DepthCloud& cloud, const Plane& plane, double margin)
{
  const auto& points = cloud.sparsePoints();
  const auto below = std::count_if(
      points.begin(), points.end(),
      [&](const auto& p)
      { return plane.signedDistance(p) < -margin * std::max(1.0, 0.5 * p.z()); });
  return points.empty() ? 0.0 : static_cast<double>(below) / static_cast<double>(points.size());
}

void markHollow(ScenePlanes& planes, const DepthCloud& cloud, const SurfaceOptions& options)
{
  for (const int i : planes.horizontal)
  {
    ScenePlane& plane = planes.all.planes[static_cast<std::size_t>(i)];
    if (plane.extent.area() >= kMinFloorArea) plane.isFurniture = isHollow(cloud, plane, options);
  }
}

void useKnownFloor(ScenePlanes& planes, const DepthCloud& cloud, const Plane& known)
{
  constexpr double kClearly = 0.15;  // below the floor [m]; poses err
  const double own =
      planes.floor ? known.signedDistance(planes.plane(*planes.floor).centroid) : kSameFloorInFrame;
  if (std::abs(own) < kSameFloorInFrame) return;
  const auto shown = atFloor(planes, known);
  if (own < 0)
    for (ScenePlane* plane : shown) plane->isFloor = true;
  planes.contradictsFloor = shown.empty() && shareBelow(cloud, known, kClearly) > kMaxBelowFloor;
  if (own < 0 || planes.contradictsFloor) return;
  planes.floorSeen = false;
  planes.floor = static_cast<int>(planes.all.planes.size());
  ScenePlane floor;
  floor.plane = known;
  floor.centroid = -known.d * known.n;
  planes.all.planes.push_back(std::move(floor));
  planes.horizontal.insert(planes.horizontal.begin(), *planes.floor);
}

bool isFloorThatEnds(const ScenePlanes& planes, const Eigen::Vector3d& point, double area)
{
  if (area < kMinFloorArea || !planes.floor) return false;
  return std::abs(planes.plane(*planes.floor).plane.signedDistance(point)) > kSameFloorInFrame;
}

}  // namespace quadmap
