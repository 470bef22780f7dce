#pragma once

#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
/** Half of what an object's cuboid extends over along a unit vector of the reference frame [m]:
 * doc/mathematics.md, (23.1). */
inline double cuboidHalfExtent(const Ellipsoid& object, const Eigen::Vector3d& n)
{
  return (object.rotation().transpose() * n).cwiseAbs().dot(object.semiAxes());
}

/** Height of the lowest point of an object's cuboid in a frame whose z is up [m]. */
inline double cuboidBottom(const Ellipsoid& object)
{
  return object.center().z() - cuboidHalfExtent(object, Eigen::Vector3d::UnitZ());
}

}  // namespace quadmap
