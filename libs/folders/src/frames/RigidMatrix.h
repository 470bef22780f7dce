#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>

#include "quadmap/obs/Plausible.h"

namespace quadmap
{
/** Whether a matrix is a rotation with a translation. Files round. */
inline bool isRigid(const Eigen::Matrix4d& T)
{
  constexpr double kRounding = 1e-2;
  return T.allFinite() && isRotation(T.topLeftCorner<3, 3>()) &&
         (T.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() < kRounding;
}

/** The pose that a rigid matrix is nearest to. */
inline mrpt::poses::CPose3D poseOf(const Eigen::Matrix4d& T)
{
  const Eigen::Quaterniond q(Eigen::Matrix3d(T.topLeftCorner<3, 3>()));
  return mrpt::poses::CPose3D::FromRotationAndTranslation(
      Eigen::Matrix3d(q.normalized().toRotationMatrix()),
      Eigen::Vector3d(T.topRightCorner<3, 1>()));
}

}  // namespace quadmap
