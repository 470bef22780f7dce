#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>

namespace quadmap
{
/** The same motion for many points: a pose of MRPT moves one at a time, and slowly. */
inline Eigen::Isometry3d isometryOf(const mrpt::poses::CPose3D& pose)
{
  Eigen::Isometry3d T;
  T.matrix() = pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen();
  return T;
}

}  // namespace quadmap
