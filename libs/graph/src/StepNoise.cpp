#include "quadmap/graph/StepNoise.h"

#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "GraphProblem.h"
#include "SparseInverse.h"
#include "quadmap/estimation/NormalEquations.h"

// What odometry errs by: (16.21) and (16.22) of doc/mathematics.md.
namespace quadmap
{
namespace
{
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/** Residuals of a step, in standard deviations, and their derivatives by the increments of the two
 * poses it joins. */
struct Linearised
{
  Vector6 r;
  std::array<Matrix6, 2> J;
};

Linearised linearised(
    const mrpt::poses::CPose3DPDFGaussian& step,
    const ceres::Manifold& manifold,
    const std::array<const double*, 2>& poses)
{
  using RowMajor67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;
  using RowMajor76 = Eigen::Matrix<double, 7, 6, Eigen::RowMajor>;
  Linearised out;
  std::array<RowMajor67, 2> perBlock;
  std::array<double*, 2> jacobians = {perBlock[0].data(), perBlock[1].data()};
  createOdometryFactor(step)->Evaluate(poses.data(), out.r.data(), jacobians.data());
  for (std::size_t end = 0; end < 2; ++end)
  {
    RowMajor76 plus;
    manifold.PlusJacobian(poses[end], plus.data());
    out.J[end] = perBlock[end] * plus;
  }
  return out;
}

double scaleOf(const StepFit::Sums& sums, double claimWeight)
{
  // Rounding leaves redundancies below zero where nothing but the odometry says anything.
  return std::sqrt(
      (claimWeight + sums.squares) / (claimWeight + std::max(0.0, sums.redundancy)));  // (16.22)
}

/** Blocks of H^-1 of the few poses that are asked for, which take less time than its sparse
 * entries. */
class SolvedColumns
{
 public:
  explicit SolvedColumns(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& H) : H_(H) {}

  Matrix6 operator()(Eigen::Index row, Eigen::Index column)
  {
    auto& solved = columns_[column];
    if (solved.size() == 0)
    {
      Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(H_.rows(), 6);
      unit.middleRows(column, 6).setIdentity();
      solved = H_.solve(unit);
    }
    return solved.middleRows(row, 6);
  }

 private:
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& H_;
  std::map<Eigen::Index, Eigen::MatrixXd> columns_;
};

}  // namespace

mrpt::poses::CPose3DPDFGaussian scaled(mrpt::poses::CPose3DPDFGaussian step, const StepNoise& noise)
{
  Vector6 scale;
  scale << Eigen::Vector3d::Constant(noise.position), Eigen::Vector3d::Constant(noise.angle);
  step.cov.asEigen() = scale.asDiagonal() * step.cov.asEigen() * scale.asDiagonal();
  return step;
}

StepFit& StepFit::operator+=(const StepFit& other)
{
  position.squares += other.position.squares;
  position.redundancy += other.position.redundancy;
  angle.squares += other.angle.squares;
  angle.redundancy += other.angle.redundancy;
  return *this;
}

StepNoise StepNoise::atLeastClaimed() const
{
  return {std::max(1.0, position), std::max(1.0, angle)};
}

StepNoise stepNoiseOf(const StepFit& fit, double claimWeight)
{
  return {scaleOf(fit.position, claimWeight), scaleOf(fit.angle, claimWeight)};
}

StepFit GraphProblem::stepFit(
    const NormalMatrix& normal,
    const JointCovariance& covariance,
    std::pair<std::size_t, std::size_t> steps) const
{
  StepFit fit;
  for (std::size_t k = std::max(steps.first, firstFree_); k < steps.second; ++k)
    for (const auto& step : graph_.stepsByPose_.at(k))
    {
      if (!step.isOdometry) continue;
      const std::array<std::size_t, 2> ends = {step.from, step.to};
      const auto at = linearised(
          step.believed(graph_.stepNoise_), *poseManifold_,
          {graph_.poses_[ends[0]].data(), graph_.poses_[ends[1]].data()});
      Matrix6 known = Matrix6::Zero();  // J Z J^t of (16.21)
      for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t b = 0; b < 2; ++b)
          if (ends[a] >= firstFree_ && ends[b] >= firstFree_)
            known += at.J[a] * covariance(normal.poseAt.at(ends[a]), normal.poseAt.at(ends[b])) *
                     at.J[b].transpose();
      const auto& noise = graph_.stepNoise_;
      fit.position.squares += std::pow(noise.position, 2) * at.r.head<3>().squaredNorm();
      fit.position.redundancy += 3 - known.diagonal().head<3>().sum();
      fit.angle.squares += std::pow(noise.angle, 2) * at.r.tail<3>().squaredNorm();
      fit.angle.redundancy += 3 - known.diagonal().tail<3>().sum();
    }
  return fit;
}

StepFit GraphProblem::stepFit()
{
  const NormalMatrix normal = normalMatrix(kFreePositionSigma, kFreeAngleSigma);
  if (normal.poseAt.empty()) return {};
  const Eigen::SimplicialLDLT<SparseMatrix> factorised(normal.H);
  if (factorised.info() != Eigen::Success || factorised.vectorD().minCoeff() <= 0) return {};
  const SparseInverse inverse(factorised);
  return stepFit(
      normal, [&](Eigen::Index row, Eigen::Index column) { return inverse.block(row, column, 6); },
      {firstFree_, graph_.poses_.size()});
}

FactorGraph::WindowFit GraphProblem::windowFit(std::pair<std::size_t, std::size_t> steps)
{
  FactorGraph::WindowFit fit;
  const NormalMatrix normal = normalMatrix(kFreePositionSigma, kFreeAngleSigma);
  if (normal.poseAt.empty()) return fit;
  const Eigen::SimplicialLDLT<SparseMatrix> factorised(normal.H);
  if (factorised.info() != Eigen::Success)
    throw std::runtime_error("the normal matrix of the factor graph cannot be factorised");
  SolvedColumns solved(factorised);
  const auto last = normal.poseAt.find(graph_.poses_.size() - 1);
  if (last != normal.poseAt.end())
  {
    const Matrix6 block = solved(last->second, last->second);
    fit.lastPose = 0.5 * (block + block.transpose());
  }
  if (factorised.vectorD().minCoeff() > 0) fit.steps = stepFit(normal, std::ref(solved), steps);
  return fit;
}

FactorGraph::WindowFit FactorGraph::windowFit(
    std::size_t firstFree, std::pair<std::size_t, std::size_t> steps)
{
  return GraphProblem(*this, firstFree, true).windowFit(steps);
}

StepFit FactorGraph::stepFit() { return GraphProblem(*this, 1, false).stepFit(); }

}  // namespace quadmap
