#include "StepCovariance.h"

#include <cmath>

namespace quadmap
{
/** With x = (d, w) the position moves by d + w x t and the angles by E^-1 w. The columns of E are
 * the axes of yaw (z), pitch (y after yaw) and roll (x after both), in the frame `from`. */
mrpt::poses::CPose3DPDFGaussian gaussianOf(
    const Eigen::Isometry3d& T_from_to, const Matrix6& covarianceInFrom)
{
  constexpr double kMinCosine = 1e-3;  // of the pitch, as 90 degrees leave yaw undefined
  mrpt::poses::CPose3DPDFGaussian result(poseOf(T_from_to));
  const double yaw = result.mean.yaw();
  const double cosine = std::max(kMinCosine, std::cos(result.mean.pitch()));
  Eigen::Matrix3d E;
  E.col(0) = Eigen::Vector3d::UnitZ();
  E.col(1) = Eigen::Vector3d(-std::sin(yaw), std::cos(yaw), 0);
  E.col(2) = Eigen::Vector3d(
      std::cos(yaw) * cosine, std::sin(yaw) * cosine, -std::sin(result.mean.pitch()));
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>().setIdentity();
  J.topRightCorner<3, 3>() = -crossMatrix(T_from_to.translation());
  J.bottomRightCorner<3, 3>() = E.inverse();
  result.cov = (J * covarianceInFrom * J.transpose()).eval();
  return result;
}

}  // namespace quadmap
