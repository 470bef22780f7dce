#include "quadmap/geometry/Plane.h"

#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
Plane Plane::transformed(const mrpt::poses::CPose3D& T_a_b) const
{
  const Eigen::Matrix3d R_a_b = T_a_b.getRotationMatrix().asEigen();
  const Eigen::Vector3d n_a = R_a_b * n;
  // n_b.p_b + d = n_a.(p_a - t) + d
  return {n_a, d - n_a.dot(positionOf(T_a_b))};
}

}  // namespace quadmap
