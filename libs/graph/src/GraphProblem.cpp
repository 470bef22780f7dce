#include "GraphProblem.h"

#include <ceres/solver.h>

#include <algorithm>

namespace quadmap
{
namespace
{
ceres::Problem::Options problemOptions()
{
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

}  // namespace

GraphProblem::GraphProblem(FactorGraph& graph, std::size_t firstFree, bool folded) :
    graph_(graph),
    firstFree_(std::max<std::size_t>(firstFree, 1)),
    folded_(folded),
    firstView_(folded ? graph.foldedUpTo_ : 0),
    poseManifold_(poseManifold()),
    freeManifold_(objectManifold(ObjectFreedom::Free)),
    problem_(problemOptions())
{
  for (std::size_t k = firstView_; k < graph.poses_.size(); ++k)
  {
    for (const auto& view : graph.viewsByPose_[k])
      if (graph.hasObject(view.object)) addView(k, view);
    if (k < firstFree_) continue;
    for (const auto& step : graph.stepsByPose_[k]) addStep(step);
  }
  addFloors();
}

void GraphProblem::addStep(const FactorGraph::Step& step)
{
  double* from = poseBlock(step.from);
  double* to = poseBlock(step.to);
  problem_.AddResidualBlock(
      createOdometryFactor(step.believed(graph_.stepNoise_)).release(), nullptr, from, to);
}

void GraphProblem::addView(std::size_t pose, const FactorGraph::View& view)
{
  const auto& object = graph_.objects_.at(view.object);
  views_[view.object].emplace_back(pose, &view.view);
  double* objectAt = objectBlock(view.object);
  problem_.AddResidualBlock(
      createViewFactor(
          view.view, object.label.shapeExponent, graph_.options_.estimator.huber, object.freedom)
          .release(),
      nullptr, poseBlock(pose), objectAt);
}

double* GraphProblem::poseBlock(std::size_t index)
{
  auto [it, isNew] = poses_.try_emplace(index, graph_.poses_.at(index).data());
  if (!isNew) return it->second;
  problem_.AddParameterBlock(it->second, 7, poseManifold_.get());
  if (index < firstFree_) problem_.SetParameterBlockConstant(it->second);
  return it->second;
}

double* GraphProblem::objectBlock(ObjectId id)
{
  auto& object = graph_.objects_.at(id);
  auto [it, isNew] = objects_.try_emplace(id, object.block.data());
  if (!isNew) return it->second;
  double* block = it->second;
  problem_.AddParameterBlock(
      block, blockSize(object.freedom),
      object.freedom == ObjectFreedom::Free ? freeManifold_.get() : nullptr);
  problem_.AddResidualBlock(
      createLabelPrior(object.label, graph_.options_.estimator, object.freedom).release(), nullptr,
      block);
  if (object.prior)
    problem_.AddResidualBlock(
        createObjectPrior(*object.prior, object.freedom).release(), nullptr, block);
  if (folded_ && object.folded)
    problem_.AddResidualBlock(
        createObjectPrior(*object.folded, object.freedom).release(), nullptr, block);
  return block;
}

FactorGraph::Summary GraphProblem::solve()
{
  ceres::Solver::Options options;
  // Eigen's own factorisation: no BLAS whose number of threads would change the last digits.
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  options.max_num_iterations = graph_.options_.maxIterations;
  options.function_tolerance = 1e-5;
  options.parameter_tolerance = 1e-7;
  options.logging_type = ceres::SILENT;

  FactorGraph::Summary summary;
  if (problem_.NumResidualBlocks() == 0) return summary;
  ceres::Solver::Summary result;
  ceres::Solve(options, &problem_, &result);
  summary.converged = result.termination_type == ceres::CONVERGENCE;
  summary.iterations = static_cast<int>(result.iterations.size());
  summary.initialCost = result.initial_cost;
  summary.finalCost = result.final_cost;
  for (const auto& [index, block] : poses_) summary.freePoses += index >= firstFree_ ? 1 : 0;
  summary.freeObjects = objects_.size();
  summary.residuals = static_cast<std::size_t>(problem_.NumResiduals());
  return summary;
}

FactorGraph::Summary FactorGraph::optimise() { return GraphProblem(*this, 1, false).solve(); }

FactorGraph::Summary FactorGraph::optimiseObjects()
{
  return GraphProblem(*this, poses(), false).solve();
}

FactorGraph::Summary FactorGraph::optimiseWindow(std::size_t firstFree)
{
  foldBefore(firstFree);
  return GraphProblem(*this, foldedUpTo_, true).solve();
}

}  // namespace quadmap
