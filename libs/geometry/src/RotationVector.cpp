#include "quadmap/geometry/RotationVector.h"

#include <cmath>

namespace quadmap
{
Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v)
{
  Eigen::Matrix3d M;
  M << 0, -v.z(), v.y(),  //
      v.z(), 0, -v.x(),   //
      -v.y(), v.x(), 0;
  return M;
}

Eigen::Quaterniond rotationOf(const Eigen::Vector3d& v)
{
  const double angle = v.norm();
  const double sinc = angle > 1e-6 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48;
  const Eigen::Vector3d axis = sinc * v;
  return {std::cos(0.5 * angle), axis.x(), axis.y(), axis.z()};
}

Eigen::Quaterniond turnToZ(const Eigen::Vector3d& direction)
{
  return Eigen::Quaterniond::FromTwoVectors(direction, Eigen::Vector3d::UnitZ());
}

Eigen::Matrix3d inverseLeftJacobian(const Eigen::Vector3d& v)
{
  const double angle = v.norm();
  // With the angle a: 1/a^2 - (1 + cos a)/(2 a sin a) = 1/12 + a^2/720 + ...
  const double factor = angle < 1e-3 ? 1.0 / 12 + angle * angle / 720
                                     : 1 / (angle * angle) - 0.5 / (angle * std::tan(0.5 * angle));
  const Eigen::Matrix3d V = crossMatrix(v);
  return Eigen::Matrix3d::Identity() - 0.5 * V + factor * V * V;
}

}  // namespace quadmap
