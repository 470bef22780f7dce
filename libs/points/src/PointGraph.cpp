#include "PointGraph.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <stdexcept>

#include "PointFactors.h"

namespace quadmap
{
template <int D>
double PointGraph<D>::optimise(double huber, int maxIterations)
{
  if (sights.empty()) return 0;
  std::vector<PointPoseBlock<D>> blocks;
  for (const auto& pose : poses) blocks.push_back(pointBlockOf<D>(pose));

  ceres::Problem problem;
  for (auto& block : blocks)
  {
    problem.AddParameterBlock(
        block.data(), static_cast<int>(block.size()), pointPoseManifold<D>().release());
    if (posesFixed) problem.SetParameterBlockConstant(block.data());
  }
  problem.SetParameterBlockConstant(blocks.front().data());
  for (std::size_t k = 0; k < steps.size() && !posesFixed; ++k)
    problem.AddResidualBlock(
        createPointStepFactor<D>(steps[k]).release(), nullptr, blocks[k].data(),
        blocks[k + 1].data());
  for (const auto& sight : sights)
    problem.AddResidualBlock(
        createSightFactor<D>(sight).release(), new ceres::HuberLoss(huber),
        blocks[sight.pose].data(), objects[sight.object].data());

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // in every build of Ceres
  options.max_num_iterations = maxIterations;
  options.num_threads = 1;  // gives the same bytes on every machine
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw std::runtime_error("points: " + summary.message);
  for (std::size_t k = 0; k < poses.size(); ++k) poses[k] = pointPoseOf<D>(blocks[k]);
  return summary.final_cost;
}

template double PointGraph<2>::optimise(double, int);
template double PointGraph<3>::optimise(double, int);

}  // namespace quadmap
