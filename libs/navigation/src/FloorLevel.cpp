#include "FloorLevel.h"

#include <algorithm>

#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

CPose3D FloorLevel::levelled(const CPose3D& T_odom_robot) const
{
  const Eigen::Matrix3d R = R_level_odom_ * T_odom_robot.getRotationMatrix().asEigen();
  const Eigen::Vector3d p = positionOf(T_odom_robot);
  return CPose3D::FromRotationAndTranslation(mrpt::math::CMatrixDouble33(R), p);
}

void FloorLevel::look(const FrameSurfaces& seen, const CPose3D& T_level_sensor)
{
  const auto floor = std::find_if(
      seen.seen.begin(), seen.seen.end(),
      [](const SurfacePatch& patch) { return patch.kind == SurfaceKind::Floor; });
  if (floor == seen.seen.end()) return;
  const Eigen::Vector3d up = floor->plane.transformed(T_level_sensor).n;
  R_level_odom_ = Eigen::Quaterniond::Identity().slerp(share_, turnToZ(up)) * R_level_odom_;
}

}  // namespace quadmap
