#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <cmath>

namespace quadmap
{
/** Derivatives of a small turn about the axes of the turned frame by (yaw, pitch, roll) of its
 * pose. */
inline Eigen::Matrix3d localTurnsPerAngle(const mrpt::poses::CPose3D& pose)
{
  const double sp = std::sin(pose.pitch()), cp = std::cos(pose.pitch());
  const double sr = std::sin(pose.roll()), cr = std::cos(pose.roll());
  Eigen::Matrix3d J;
  J << -sp, 0, 1,      //
      sr * cp, cr, 0,  //
      cr * cp, -sr, 0;
  return J;
}

}  // namespace quadmap
