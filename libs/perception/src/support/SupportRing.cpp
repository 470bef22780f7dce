#include "support/SupportRing.h"

#include <algorithm>
#include <cmath>

#include "cloud/BoxSurroundings.h"
#include "cloud/Precision.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
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
    const Eigen::Vector3d& up,
    const ImageBox& box,
    const PerceptionOptions& options)
{
  const auto outer = cloud.cellsOf(withSurroundings(box));
  const auto inner = cloud.cellsOf(box);
  const Eigen::Vector2d down = downInImage(cloud.camera(), up, box);
  const int step = stepFor(std::max(0, outer.cells() - inner.cells()), kSample);
  std::vector<RingPoint> out;
  for (int r = outer.r0; r < outer.r1; r += step)
    for (int c = outer.c0; c < outer.c1; c += step)
    {
      if (!cloud.valid(c, r) || inner.contains(c, r)) continue;
      RingPoint point;
      point.lower =
          down.dot(Eigen::Vector2d(
              c * cloud.stride() - box.centerX(), r * cloud.stride() - box.centerY())) > 0;
      point.point = cloud.point(c, r).cast<double>();
      point.tolerance = contactTolerance(point.point.z(), options);
      out.push_back(point);
    }
  return out;
}

double shareOn(const std::vector<RingPoint>& points, const Plane& plane, Ring ring)
{
  int all = 0, on = 0;
  for (const auto& p : points)
  {
    if (ring == Ring::LowerHalf && !p.lower) continue;
    ++all;
    on += std::abs(plane.signedDistance(p.point)) > p.tolerance ? 0 : 1;
  }
  return all > 0 ? static_cast<double>(on) / all : 0.0;
}

}  // namespace quadmap
