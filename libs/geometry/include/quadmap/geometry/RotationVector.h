#pragma once

#include <Eigen/Dense>

namespace quadmap
{
/** The matrix [v]x, with [v]x w = v x w. */
Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v);

/** exp(v): the rotation by |v| about v [rad]. */
Eigen::Quaterniond rotationOf(const Eigen::Vector3d& v);

/** log(q): the rotation vector of q, the shorter way round, so that |v| <= pi [rad]. */
Eigen::Vector3d rotationVectorOf(const Eigen::Quaterniond& q);

/** Inverse left Jacobian J of SO(3), for |v| < 2 pi: log(exp(w) exp(v)) = v + J w for small w. */
Eigen::Matrix3d inverseLeftJacobian(const Eigen::Vector3d& v);

}  // namespace quadmap
