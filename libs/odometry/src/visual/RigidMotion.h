#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
using Vector6 = Eigen::Matrix<double, 6, 1>;  //!< A small motion: translation [m], turn [rad]
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** The motion of a small increment. The rotation is exact, and the coupling with the translation is
 * of first order. That suffices for iterations, each of which starts from the last result. */
inline Eigen::Isometry3d smallMotion(const Vector6& step)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const double angle = step.tail<3>().norm();
  if (angle > 0) T.linear() = Eigen::AngleAxisd(angle, step.tail<3>() / angle).toRotationMatrix();
  T.translation() = step.head<3>();
  return T;
}

/** The adjoint Ad, which carries small motions from frame b to frame a:
 * T_a_b exp(x) = exp(Ad x) T_a_b. */
inline Matrix6 adjoint(const Eigen::Isometry3d& T_a_b)
{
  Matrix6 A = Matrix6::Zero();
  A.topLeftCorner<3, 3>() = A.bottomRightCorner<3, 3>() = T_a_b.linear();
  A.topRightCorner<3, 3>() = crossMatrix(T_a_b.translation()) * T_a_b.linear();
  return A;
}

inline double angleOf(const Eigen::Isometry3d& T)  //!< [rad], >= 0
{
  return Eigen::AngleAxisd(T.linear()).angle();
}

inline Eigen::Isometry3d isometryOf(const mrpt::poses::CPose3D& pose)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = pose.getRotationMatrix().asEigen();
  T.translation() = positionOf(pose);
  return T;
}

inline mrpt::poses::CPose3D poseOf(const Eigen::Isometry3d& T)
{
  const Eigen::Matrix3d R = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return mrpt::poses::CPose3D::FromRotationAndTranslation(R, Eigen::Vector3d(T.translation()));
}

}  // namespace quadmap
