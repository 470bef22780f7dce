#include "support/SupportRing.h"

#include <algorithm>
#include <cmath>

#include "cloud/BoxSurroundings.h"
#include "cloud/Precision.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
namespace
{
/** Distance to the horizontal plane that a point most likely lies on [m]: its tolerance when none
 * was seen there. */
double nearestPlane(const ScenePlanes& planes, const RingPoint& point)
{
  double nearest = point.tolerance;
  for (const int i : planes.horizontal)
  {
    const ScenePlane& plane = planes.plane(i);
    const double distance = std::abs(plane.plane.signedDistance(point.point));
    if (distance < nearest && plane.extent.isWithin(point.point, 0.0)) nearest = distance;
  }
  return nearest;
}

}  // namespace

Eigen::Vector2d downInImage(
    const PinholeCamera& camera, const Eigen::Vector3d& up, const ImageBox& box)
{
  const Eigen::Vector3d ray = camera.ray(box.centerX(), box.centerY());
  const Eigen::Vector2d down(
      camera.fx * (ray.x() * up.z() - up.x()), camera.fy * (ray.y() * up.z() - up.y()));
  return down.norm() > 0 ? down.normalized() : Eigen::Vector2d::UnitY();
}

std::vector<RingPoint> ringAround(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    const PerceptionOptions& options)
{
  const auto outer = cloud.cellsOf(withSurroundings(box));
  const auto inner = cloud.cellsOf(box);
  const Eigen::Vector2d down = downInImage(cloud.camera(), planes.up, box);
  const double halfHeight =
      0.5 * (std::abs(down.x()) * box.width() + std::abs(down.y()) * box.height());
  const int step = stepFor(std::max(0, outer.cells() - inner.cells()), kSample);
  std::vector<RingPoint> out;
  for (int r = outer.r0; r < outer.r1; r += step)
    for (int c = outer.c0; c < outer.c1; c += step)
    {
      if (!cloud.valid(c, r)) continue;
      // From the middle of the box down, in half heights.
      const double below =
          down.dot(Eigen::Vector2d(
              c * cloud.stride() - box.centerX(), r * cloud.stride() - box.centerY())) /
          halfHeight;
      RingPoint point;
      point.inBox = inner.contains(c, r);
      if (point.inBox && below < 0.8) continue;
      point.lower = below > 0;
      point.point = cloud.point(c, r).cast<double>();
      point.noise = options.depthSigma(point.point.z());
      point.tolerance = contactTolerance(point.point.z(), options);
      point.nearest = nearestPlane(planes, point);
      point.onSurface = !point.inBox && cloud.normal(c, r);
      out.push_back(point);
    }
  return out;
}

void findBeside(
    std::vector<RingPoint>& points,
    const RoughObject& object,
    const LabelProperties& label,
    const Eigen::Vector3d& up)
{
  if (object.empty()) return;
  const double reach = label.typicalSize.norm() * (1.0 + 0.5 * label.sizeSpread);
  const Eigen::Vector3d& middle = object.points[object.points.size() / 2];
  for (auto& p : points) p.beside = up.cross(p.point - middle).norm() < reach;
}

RingEvidence ringOn(const std::vector<RingPoint>& points, const Plane& plane, Ring ring)
{
  RingEvidence out;
  int all = 0, on = 0;
  for (const auto& p : points)
  {
    if (ring == Ring::All ? p.inBox : !p.lower) continue;
    ++all;
    const double distance = std::abs(plane.signedDistance(p.point));
    if (distance > p.tolerance) continue;
    if (ring == Ring::LowerHalf && (!p.beside || distance > p.nearest + p.noise)) continue;
    ++on;
    if (p.onSurface) out.surface.push_back(p.point);
  }
  if (all > 0) out.share = static_cast<double>(on) / all;
  return out;
}

}  // namespace quadmap
