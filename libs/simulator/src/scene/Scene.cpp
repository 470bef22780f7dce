#include "quadmap/simulator/Scene.h"

#include <limits>

namespace quadmap::simulator
{
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
