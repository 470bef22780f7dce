#include "OdometryChain.h"

#include <mrpt/poses/Lie/SE.h>

#include <algorithm>
#include <utility>

namespace quadmap
{
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** Of the position of each keyframe relative to the first, by the odometry [m^2]. */
std::vector<double> odometryVariances(const std::vector<Keyframe>& keyframes)
{
  std::vector<double> out;
  double variance = 0;
  for (const Keyframe& keyframe : keyframes)
  {
    if (const auto& step = keyframe.odometryStep)
      variance += step->cov.asEigen().diagonal().head<3>().sum();
    out.push_back(variance);
  }
  return out;
}

}  // namespace

std::optional<CPose3D> OdometryMotion::next(const CPose3D& T_odom_robot)
{
  const auto before = std::exchange(last_, T_odom_robot);
  if (!before) return std::nullopt;
  return T_odom_robot - *before;
}

CPose3DPDFGaussian stiffAtRest(CPose3DPDFGaussian step)
{
  constexpr double kRest = 1e-4;       // [m], [rad]: less than this is no motion
  constexpr double kVariance = 1e-10;  // [m^2], [rad^2]
  const Eigen::Matrix3d R = step.mean.getRotationMatrix().asEigen();
  if (step.mean.norm() > kRest || (R - Eigen::Matrix3d::Identity()).norm() > kRest) return step;
  step.cov.setZero();
  for (int i = 0; i < 6; ++i) step.cov(i, i) = kVariance;
  return step;
}

CPose3D alignmentWithOdometry(
    const std::function<CPose3D(std::size_t)>& poseOf, const std::vector<Keyframe>& keyframes)
{
  const std::vector<double> variances = odometryVariances(keyframes);
  const auto first =
      std::find_if(variances.begin(), variances.end(), [](double v) { return v > 0; });
  if (first == variances.end()) return CPose3D();
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  double weights = 0;
  for (std::size_t k = 0; k < keyframes.size(); ++k)
  {
    // (16.19) of doc/mathematics.md
    const double weight = *first / (*first + variances[k]);
    const CPose3D difference = keyframes[k].T_odom_robot + (-poseOf(k));
    sum += weight * mrpt::poses::Lie::SE<3>::log(difference).asEigen();
    weights += weight;
  }
  mrpt::poses::Lie::SE<3>::tangent_vector mean;
  mean.asEigen() = sum / weights;
  return mrpt::poses::Lie::SE<3>::exp(mean);
}

double movePoses(
    const CPose3D& T_map_graph,
    const std::function<CPose3D(std::size_t)>& poseOf,
    std::vector<Keyframe>& keyframes)
{
  double farthest = 0;
  for (std::size_t k = 0; k < keyframes.size(); ++k)
  {
    CPose3D& pose = keyframes[k].T_map_robot;
    const CPose3D moved = T_map_graph + poseOf(k);
    farthest = std::max(farthest, pose.distanceTo(moved));
    pose = moved;
  }
  return farthest;
}

}  // namespace quadmap
