#include "StepCovariance.h"

#include "quadmap/geometry/PoseAngles.h"

namespace quadmap
{
/** With x = (d, w) the position moves by d + w x t, and the angles by the turn w. */
mrpt::poses::CPose3DPDFGaussian gaussianOf(
    const Eigen::Isometry3d& T_from_to, const Matrix6& covarianceInFrom)
{
  mrpt::poses::CPose3DPDFGaussian result(poseOf(T_from_to));
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>().setIdentity();
  J.topRightCorner<3, 3>() = -crossMatrix(T_from_to.translation());
  J.bottomRightCorner<3, 3>() = anglesPerTurn(result.mean);
  result.cov = (J * covarianceInFrom * J.transpose()).eval();
  return result;
}

}  // namespace quadmap
