#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace quadmap
{
/** Derivatives of a small turn about the axes of the turned frame by (yaw, pitch, roll) of its
 * pose. \param leastCosine The cosine of the pitch is taken as no less: at a pitch of 90 degrees
 * yaw and roll are one, and the matrix has no inverse. */
inline Eigen::Matrix3d localTurnsPerAngle(
    const mrpt::poses::CPose3D& pose, double leastCosine = 0.0)
{
  const double sp = std::sin(pose.pitch()), cp = std::max(leastCosine, std::cos(pose.pitch()));
  const double sr = std::sin(pose.roll()), cr = std::cos(pose.roll());
  Eigen::Matrix3d J;
  J << -sp, 0, 1,      //
      sr * cp, cr, 0,  //
      cr * cp, -sr, 0;
  return J;
}

/** Cosine of the pitch below which yaw and roll say the same: 0.06 degrees off straight down. */
constexpr double kLeastPitchCosine = 1e-3;

/** Derivatives of (yaw, pitch, roll) of a pose by a small turn about the axes of the frame that the
 * pose is given in. \param leastCosine As above. */
inline Eigen::Matrix3d anglesPerTurn(
    const mrpt::poses::CPose3D& pose, double leastCosine = kLeastPitchCosine)
{
  const Eigen::Matrix3d R = pose.getRotationMatrix().asEigen();
  return localTurnsPerAngle(pose, leastCosine).inverse() * R.transpose();
}

}  // namespace quadmap
