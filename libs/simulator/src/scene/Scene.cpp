#include "quadmap/simulator/Scene.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace quadmap::simulator
{
mrpt::poses::CPose3D SceneObject::poseAt(double time) const
{
  if (way.empty() || time <= way.front().time)
    return way.empty() ? T_world_obj : way.front().T_world_obj;
  const auto next = std::find_if(
      way.begin(), way.end(), [&](const WayPoint& point) { return point.time > time; });
  if (next == way.end()) return way.back().T_world_obj;
  const auto &a = std::prev(next)->T_world_obj, &b = next->T_world_obj;
  const double t = (time - std::prev(next)->time) / (next->time - std::prev(next)->time);
  return {
      a.x() + t * (b.x() - a.x()),
      a.y() + t * (b.y() - a.y()),
      a.z() + t * (b.z() - a.z()),
      a.yaw() + t * mrpt::math::wrapToPi(b.yaw() - a.yaw()),
      0,
      0};
}

Ellipsoid SceneObject::truth() const
{
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(infinity), high = -low;
  for (const auto& part : parts)
  {
    const auto& t = part.T_obj_prim;
    const Eigen::Vector3d center(t.x(), t.y(), t.z()), half = halfExtent(part);
    low = low.cwiseMin(center - half);
    high = high.cwiseMax(center + half);
  }
  const Eigen::Vector3d center = 0.5 * (low + high);
  const mrpt::poses::CPose3D T_obj_box(center.x(), center.y(), center.z());
  return Ellipsoid(T_world_obj + T_obj_box, 0.5 * (high - low));
}

}  // namespace quadmap::simulator
