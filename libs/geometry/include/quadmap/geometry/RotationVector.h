#pragma once

#include <Eigen/Dense>

namespace quadmap
{
/** [v]x: crossMatrix(v) w = v x w. */
Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v);

/** The rotation by |v| radians about v, and back (the shorter way round, |v| <= pi). */
Eigen::Quaterniond rotationOf(const Eigen::Vector3d& v);
Eigen::Vector3d rotationVectorOf(const Eigen::Quaterniond& q);

/** Inverse left Jacobian of SO(3): log(exp(w) exp(v)) = v + J w for small w. |v| < 2 pi. */
Eigen::Matrix3d inverseLeftJacobian(const Eigen::Vector3d& v);

}  // namespace quadmap
