#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>

namespace quadmap
{
/** The position of a pose [m]: where the origin of b is in a, for T_a_b. */
inline Eigen::Vector3d positionOf(const mrpt::poses::CPose3D& T_a_b)
{
  return {T_a_b.x(), T_a_b.y(), T_a_b.z()};
}

}  // namespace quadmap
