#include "quadmap/geometry/PinholeCamera.h"

namespace quadmap
{
Eigen::Matrix3d PinholeCamera::matrix() const
{
  Eigen::Matrix3d K;
  K << fx, 0, cx, 0, fy, cy, 0, 0, 1;
  return K;
}

const mrpt::poses::CPose3D& T_sensor_optical()
{
  static const mrpt::poses::CPose3D T = []
  {
    // The columns are the optical axes (right, down, forward) in sensor axes (forward, left, up).
    mrpt::math::CMatrixDouble33 R;
    R.asEigen() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    const auto pose = mrpt::poses::CPose3D::FromRotationAndTranslation(
        R, mrpt::math::CVectorFixedDouble<3>(mrpt::math::TPoint3D(0, 0, 0)));
    pose.yaw();  // fills CPose3D's cache, so that threads may share the pose
    return pose;
  }();
  return T;
}

}  // namespace quadmap
