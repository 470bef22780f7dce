#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>

#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
/** A pose T_a_b when axes of both frames change their directions: D_a T_a_b D_b. With a reflection
 * on each side it is a pose again.
 * \param a, b The diagonals of D_a and D_b: 1 or -1 for each axis, of equal products. */
inline mrpt::poses::CPose3D reflected(
    const mrpt::poses::CPose3D& T_a_b, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const Eigen::Matrix3d R = T_a_b.getRotationMatrix().asEigen();
  return mrpt::poses::CPose3D::FromRotationAndTranslation(
      Eigen::Matrix3d(a.asDiagonal() * R * b.asDiagonal()),
      Eigen::Vector3d(a.cwiseProduct(positionOf(T_a_b))));
}

}  // namespace quadmap
