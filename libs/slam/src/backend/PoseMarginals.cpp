#include "PoseMarginals.h"

#include "quadmap/geometry/PoseAngles.h"

namespace quadmap
{
using Matrix6 = Eigen::Matrix<double, 6, 6>;

std::optional<mrpt::math::CMatrixDouble66> covarianceOfPose(
    const mrpt::poses::CPose3D& T_map_robot, const Matrix6& covarianceOfStep)
{
  if (std::abs(std::cos(T_map_robot.pitch())) < kLeastPitchCosine) return std::nullopt;
  Matrix6 J = Matrix6::Zero();
  J.topRightCorner<3, 3>().setIdentity();
  J.bottomLeftCorner<3, 3>() = anglesPerTurn(T_map_robot);
  const Matrix6 covariance = J * covarianceOfStep * J.transpose();
  return mrpt::math::CMatrixDouble66(Matrix6(0.5 * (covariance + covariance.transpose())));
}

void noteMarginals(FactorGraph& graph, std::vector<Keyframe>& keyframes)
{
  const auto marginals = graph.poseMarginals();
  if (marginals.empty()) return;
  const std::size_t first = marginals.size() - keyframes.size();
  for (std::size_t k = 0; k < keyframes.size(); ++k)
    keyframes[k].covariance = covarianceOfPose(keyframes[k].T_map_robot, marginals[first + k]);
}

}  // namespace quadmap
