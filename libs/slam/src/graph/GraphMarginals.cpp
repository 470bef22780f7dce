#include <ceres/crs_matrix.h>

#include <Eigen/Sparse>

#include "GraphProblem.h"

namespace quadmap
{
namespace
{
using SparseMatrix = Eigen::SparseMatrix<double>;

/** What is known of an object's position and yaw without measurements, as in the object map. */
constexpr double kFreePositionSigma = 2.0;    // [m]
constexpr double kFreeAngleSigma = M_PI / 4;  // [rad]

SparseMatrix jacobianOf(const ceres::CRSMatrix& crs)
{
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(
      crs.num_rows, crs.num_cols, static_cast<Eigen::Index>(crs.values.size()), crs.rows.data(),
      crs.cols.data(), crs.values.data());
}

/** Columns [first, first + size) of H^-1, and of them the same rows. */
Eigen::MatrixXd marginalBlock(
    const Eigen::SimplicialLDLT<SparseMatrix>& H, Eigen::Index first, Eigen::Index size)
{
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(H.rows(), size);
  unit.middleRows(first, size).setIdentity();
  const Eigen::MatrixXd solved = H.solve(unit);
  const Eigen::MatrixXd block = solved.middleRows(first, size);
  return 0.5 * (block + block.transpose());
}

}  // namespace

FactorGraph::Marginals GraphProblem::marginals(bool withObjects)
{
  FactorGraph::Marginals result;
  // The free blocks, objects last; `objectAt` are the first columns of their steps.
  ceres::Problem::EvaluateOptions options;
  std::map<ObjectId, Eigen::Index> objectAt;
  Eigen::Index columns = 0, lastPoseAt = -1;
  for (const auto& [index, block] : poses_)
  {
    if (index < firstFree_) continue;
    options.parameter_blocks.push_back(block);
    if (index + 1 == graph_.poses_.size()) lastPoseAt = columns;
    columns += 6;
  }
  for (const auto& [id, block] : objects_)
  {
    options.parameter_blocks.push_back(block);
    objectAt[id] = columns;
    columns += stepSize(graph_.objects_.at(id).freedom);
  }
  if (problem_.HasParameterBlock(&graph_.floorHeight_))
    options.parameter_blocks.push_back(&graph_.floorHeight_);
  if (options.parameter_blocks.empty()) return result;

  ceres::CRSMatrix crs;
  problem_.Evaluate(options, nullptr, nullptr, nullptr, &crs);
  const SparseMatrix J = jacobianOf(crs);
  SparseMatrix H = J.transpose() * J;
  for (Eigen::Index i = 0; i < H.cols(); ++i) H.coeffRef(i, i) += 1e-9;
  for (const auto& [id, at] : objectAt)
  {
    const int angles = graph_.objects_.at(id).freedom == ObjectFreedom::Upright ? 1 : 3;
    for (Eigen::Index i = 0; i < 3 + angles; ++i)
    {
      const double sigma = i < 3 ? kFreePositionSigma : kFreeAngleSigma;
      H.coeffRef(at + i, at + i) += 1 / (sigma * sigma);
    }
  }
  const Eigen::SimplicialLDLT<SparseMatrix> factorised(H);
  if (lastPoseAt >= 0) result.lastPose = marginalBlock(factorised, lastPoseAt, 6);
  if (withObjects)
    for (const auto& [id, at] : objectAt)
      result.objects[id] = marginalBlock(factorised, at, stepSize(graph_.objects_.at(id).freedom));
  return result;
}

FactorGraph::Marginals FactorGraph::marginals(std::size_t firstFree, bool withObjects)
{
  return GraphProblem(*this, firstFree, firstFree > 0).marginals(withObjects);
}

std::map<ObjectId, Eigen::MatrixXd> FactorGraph::objectMarginals()
{
  return GraphProblem(*this, poses(), false).marginals(true).objects;
}

}  // namespace quadmap
