#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace quadmap
{
/** The matrix [v]x, with [v]x w = v x w. */
Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v);

/** exp(v): the rotation by |v| about v [rad]. */
Eigen::Quaterniond rotationOf(const Eigen::Vector3d& v);

/** The smallest rotation that takes a direction to +z. */
Eigen::Quaterniond turnToZ(const Eigen::Vector3d& direction);

/** log(q): the rotation vector of q, the shorter way round, so that |v| <= pi [rad].
 * \tparam T double or an automatic-differentiation scalar. */
template <typename T>
Eigen::Matrix<T, 3, 1> rotationVectorOf(const Eigen::Quaternion<T>& q)
{
  using std::atan2;
  using std::sqrt;
  const T sine2 = q.vec().squaredNorm();
  if (!(sine2 > 0.0)) return q.vec() * (T(2) / q.w());  // the root has no derivative at 0
  const T sine = sqrt(sine2);
  const T angle = T(2) * (q.w() < 0.0 ? atan2(-sine, -q.w()) : atan2(sine, q.w()));
  return q.vec() * (angle / sine);
}

/** The angle of a turn in the plane, from -pi to pi [rad]. */
template <typename T>
Eigen::Matrix<T, 1, 1> rotationVectorOf(const Eigen::Rotation2D<T>& R)
{
  using std::floor;
  const T circle(2 * M_PI);
  return Eigen::Matrix<T, 1, 1>(R.angle() - circle * floor((R.angle() + T(M_PI)) / circle));
}

/** Inverse left Jacobian J of SO(3), for |v| < 2 pi: log(exp(w) exp(v)) = v + J w for small w. */
Eigen::Matrix3d inverseLeftJacobian(const Eigen::Vector3d& v);

}  // namespace quadmap
