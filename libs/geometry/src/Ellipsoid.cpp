#include "quadmap/geometry/Ellipsoid.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <stdexcept>

#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
namespace
{
bool isFinite(const mrpt::poses::CPose3D& T)
{
  return T.getRotationMatrix().asEigen().allFinite() && std::isfinite(T.x()) &&
         std::isfinite(T.y()) && std::isfinite(T.z());
}
}  // namespace

Ellipsoid::Ellipsoid() : Ellipsoid(mrpt::poses::CPose3D(), Eigen::Vector3d::Ones()) {}

Ellipsoid::Ellipsoid(const mrpt::poses::CPose3D& T_ref_obj, const Eigen::Vector3d& semiAxes) :
    pose_(T_ref_obj), semiAxes_(semiAxes)
{
  if (!semiAxes.allFinite() || !(semiAxes.minCoeff() > 0))
    throw std::invalid_argument(mrpt::format(
        "ellipsoid: half lengths (%g, %g, %g) must be finite and positive", semiAxes.x(),
        semiAxes.y(), semiAxes.z()));
  if (!isFinite(T_ref_obj)) throw std::invalid_argument("ellipsoid: pose is not finite");
  // CPose3D fills its cache of yaw, pitch and roll when they are first read, even in a const
  // object. The cache is filled here, so that threads may share the object.
  pose_.yaw();
}

Eigen::Vector3d Ellipsoid::center() const { return positionOf(pose_); }

Eigen::Matrix3d Ellipsoid::rotation() const { return pose_.getRotationMatrix().asEigen(); }

Eigen::Matrix<double, 3, 8> Ellipsoid::cuboidCorners() const
{
  const Eigen::Matrix3d R = rotation();
  const Eigen::Vector3d t = center();
  Eigen::Matrix<double, 3, 8> corners;
  for (int i = 0; i < 8; ++i)
  {
    const Eigen::Vector3d signs((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
    corners.col(i) = R * signs.cwiseProduct(semiAxes_) + t;
  }
  return corners;
}

Eigen::Matrix3d Ellipsoid::shapeMatrix() const
{
  const Eigen::Matrix3d R = rotation();
  return R * semiAxes_.cwiseAbs2().asDiagonal() * R.transpose();
}

Eigen::Matrix4d Ellipsoid::dualQuadric() const
{
  const Eigen::Vector3d t = center();
  Eigen::Matrix4d Q;
  Q.topLeftCorner<3, 3>() = shapeMatrix() - t * t.transpose();
  Q.topRightCorner<3, 1>() = -t;
  Q.bottomLeftCorner<1, 3>() = -t.transpose();
  Q(3, 3) = -1;
  return Q;
}

Ellipsoid Ellipsoid::transformed(const mrpt::poses::CPose3D& T_new_ref) const
{
  return Ellipsoid(T_new_ref + pose_, semiAxes_);
}

}  // namespace quadmap
