#include "quadmap/geometry/StepCovariance.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** Derivatives of a composed pose by its two factors. */
struct CompositionJacobians
{
  CompositionJacobians(const CPose3D& T_map_from, const CPose3D& T_from_to)
  {
    mrpt::math::CMatrixDouble66 J_from, J_step;
    mrpt::poses::CPose3DPDF::jacobiansPoseComposition(T_map_from, T_from_to, J_from, J_step);
    from = J_from.asEigen();
    step = J_step.asEigen();
  }

  PoseCovariance from, step;
};

}  // namespace

std::optional<PoseCovariance> addedCovariance(
    const CPose3DPDFGaussian& from, const CPose3DPDFGaussian& to)
{
  constexpr double kRounding = 1e-9;  // error of sums of many steps / largest variance
  const CompositionJacobians J(from.mean, to.mean - from.mean);
  const PoseCovariance added = to.cov.asEigen() - J.from * from.cov.asEigen() * J.from.transpose();
  const PoseCovariance toStep = J.step.inverse();
  const PoseCovariance Q = toStep * added * toStep.transpose();
  if (!Q.allFinite()) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<PoseCovariance> eigen(Q);
  const double least = -kRounding * to.cov.asEigen().cwiseAbs().maxCoeff();
  if (eigen.eigenvalues().minCoeff() < least) return std::nullopt;
  return PoseCovariance(
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
      eigen.eigenvectors().transpose());
}

PoseCovariance covarianceAfterStep(
    const CPose3DPDFGaussian& from, const CPose3D& T_from_to, const PoseCovariance& Q)
{
  const CompositionJacobians J(from.mean, T_from_to);
  return J.from * from.cov.asEigen() * J.from.transpose() + J.step * Q * J.step.transpose();
}

}  // namespace quadmap
