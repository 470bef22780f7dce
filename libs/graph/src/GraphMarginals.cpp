#include <ceres/crs_matrix.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "GraphProblem.h"
#include "SparseInverse.h"
#include "quadmap/estimation/NormalEquations.h"

namespace quadmap
{
namespace
{
using SparseMatrix = Eigen::SparseMatrix<double>;

/** Loose prior of each object when covariances of poses are asked for. It keeps H invertible and
 * says nothing about poses that are joined to pose 0. */
constexpr double kLooseSigma = 100;  // [m], [rad]

/** Information that is added to every unknown, so that no pivot is zero. */
constexpr double kLeastInformation = 1e-9;

SparseMatrix jacobianOf(const ceres::CRSMatrix& crs)
{
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(
      crs.num_rows, crs.num_cols, static_cast<Eigen::Index>(crs.values.size()), crs.rows.data(),
      crs.cols.data(), crs.values.data());
}

/** The lower triangle of J^t J at the present estimate. The rows of J are made in parts: all of
 * them would take several times the memory of the result.
 * \param options With the parameter blocks. */
SparseMatrix squaredJacobian(ceres::Problem& problem, ceres::Problem::EvaluateOptions options)
{
  constexpr std::size_t kPart = 10000;  // residual blocks
  std::vector<ceres::ResidualBlockId> all;
  problem.GetResidualBlocks(&all);
  SparseMatrix H;
  for (std::size_t begin = 0; begin < all.size() || begin == 0; begin += kPart)
  {
    const auto end = std::min(all.size(), begin + kPart);
    options.residual_blocks.assign(
        all.begin() + static_cast<std::ptrdiff_t>(begin),
        all.begin() + static_cast<std::ptrdiff_t>(end));
    ceres::CRSMatrix crs;
    if (!problem.Evaluate(options, nullptr, nullptr, nullptr, &crs))
      throw std::runtime_error("the factor graph has a residual that is no number");
    const SparseMatrix J = jacobianOf(crs);
    const SparseMatrix part = SparseMatrix(J.transpose() * J).triangularView<Eigen::Lower>();
    if (begin == 0)
      H = part;
    else
      H += part;
  }
  return H;
}

/** Which poses are joined, directly or by others. */
class JoinedPoses
{
 public:
  explicit JoinedPoses(std::size_t count) : next_(count)
  {
    std::iota(next_.begin(), next_.end(), std::size_t{0});
  }

  void join(std::size_t a, std::size_t b) { next_[groupOf(a)] = groupOf(b); }

  /** One of the poses that this one is joined to: the same for all of them. */
  std::size_t groupOf(std::size_t pose)
  {
    while (next_[pose] != pose) pose = next_[pose] = next_[next_[pose]];
    return pose;
  }

 private:
  std::vector<std::size_t> next_;  // of each pose, on the way to that one
};

/** Rows and columns [first, first + size) of H^-1. */
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

GraphProblem::NormalMatrix GraphProblem::normalMatrix(double positionSigma, double angleSigma)
{
  NormalMatrix normal;
  ceres::Problem::EvaluateOptions options;  // with the free blocks, objects last
  Eigen::Index columns = 0;
  for (const auto& [index, block] : poses_)
  {
    if (index < firstFree_) continue;
    options.parameter_blocks.push_back(block);
    normal.poseAt[index] = columns;
    columns += 6;
  }
  for (const auto& [id, block] : objects_)
  {
    options.parameter_blocks.push_back(block);
    normal.objectAt[id] = columns;
    columns += incrementSize(graph_.objects_.at(id).freedom);
  }
  options.parameter_blocks.insert(options.parameter_blocks.end(), floors_.begin(), floors_.end());
  if (options.parameter_blocks.empty()) return normal;

  SparseMatrix& H = normal.H;
  H = squaredJacobian(problem_, options);
  for (Eigen::Index i = 0; i < H.cols(); ++i) H.coeffRef(i, i) += kLeastInformation;
  for (const auto& [id, at] : normal.objectAt)
  {
    const int angles = graph_.objects_.at(id).freedom == ObjectFreedom::Upright ? 1 : 3;
    for (Eigen::Index i = 0; i < 3 + angles; ++i)
    {
      const double sigma = i < 3 ? positionSigma : angleSigma;
      H.coeffRef(at + i, at + i) += 1 / (sigma * sigma);
    }
  }
  return normal;
}

bool GraphProblem::isInOnePiece() const
{
  JoinedPoses joined(graph_.poses_.size());
  for (const auto& steps : graph_.stepsByPose_)
    for (const auto& step : steps) joined.join(step.from, step.to);
  for (const auto& [id, views] : views_)
  {
    for (const auto& view : views) joined.join(view.first, views.front().first);
    if (graph_.objects_.at(id).prior) joined.join(0, views.front().first);
  }
  for (std::size_t k = 1; k < graph_.poses_.size(); ++k)
    if (joined.groupOf(k) != joined.groupOf(0)) return false;
  return true;
}

FactorGraph::Marginals GraphProblem::marginals(bool withObjects)
{
  FactorGraph::Marginals result;
  const NormalMatrix normal = normalMatrix(kFreePositionSigma, kFreeAngleSigma);
  if (normal.H.rows() == 0) return result;
  const Eigen::SimplicialLDLT<SparseMatrix> factorised(normal.H);
  if (factorised.info() != Eigen::Success)
    throw std::runtime_error("the normal matrix of the factor graph cannot be factorised");
  const auto last = normal.poseAt.find(graph_.poses_.size() - 1);
  if (last != normal.poseAt.end()) result.lastPose = marginalBlock(factorised, last->second, 6);
  if (withObjects)
    for (const auto& [id, at] : normal.objectAt)
      result.objects[id] =
          marginalBlock(factorised, at, incrementSize(graph_.objects_.at(id).freedom));
  return result;
}

std::vector<Eigen::Matrix<double, 6, 6>> GraphProblem::poseMarginals()
{
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  if (!isInOnePiece()) return {};
  std::vector<Matrix6> marginals(graph_.poses_.size(), Matrix6::Zero());
  const NormalMatrix normal = normalMatrix(kLooseSigma, kLooseSigma);
  if (normal.poseAt.empty()) return marginals;
  const Eigen::SimplicialLDLT<SparseMatrix> factorised(normal.H);
  if (factorised.info() != Eigen::Success || factorised.vectorD().minCoeff() <= 0) return {};
  const SparseInverse inverse(factorised);
  for (const auto& [index, at] : normal.poseAt) marginals[index] = inverse.block(at, 6);
  return marginals;
}

std::optional<Eigen::MatrixXd> GraphProblem::jointMarginal(
    const std::vector<std::size_t>& poses, const std::function<bool()>& shouldStop)
{
  if (!isInOnePiece()) return std::nullopt;
  const auto at = [](std::size_t i) { return 6 * static_cast<Eigen::Index>(i); };
  const NormalMatrix normal = normalMatrix(kLooseSigma, kLooseSigma);
  Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(at(poses.size()), at(poses.size()));
  if (normal.poseAt.empty()) return joint;
  const Eigen::SimplicialLDLT<SparseMatrix> factorised(normal.H);
  if (factorised.info() != Eigen::Success || factorised.vectorD().minCoeff() <= 0)
    return std::nullopt;
  for (std::size_t c = 0; c < poses.size(); ++c)
  {
    if (shouldStop()) return std::nullopt;
    const auto column = normal.poseAt.find(poses[c]);
    if (column == normal.poseAt.end()) continue;
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(normal.H.rows(), 6);
    unit.middleRows(column->second, 6).setIdentity();
    const Eigen::MatrixXd solved = factorised.solve(unit);
    for (std::size_t r = 0; r < poses.size(); ++r)
      if (const auto row = normal.poseAt.find(poses[r]); row != normal.poseAt.end())
        joint.block<6, 6>(at(r), at(c)) = solved.middleRows(row->second, 6);
  }
  return joint;
}

FactorGraph::Marginals FactorGraph::marginals(std::size_t firstFree, bool withObjects)
{
  return GraphProblem(*this, firstFree, firstFree > 0).marginals(withObjects);
}

std::vector<Eigen::Matrix<double, 6, 6>> FactorGraph::poseMarginals()
{
  return GraphProblem(*this, 1, false).poseMarginals();
}

std::optional<Eigen::MatrixXd> FactorGraph::jointMarginal(
    const std::vector<std::size_t>& poses, const std::function<bool()>& shouldStop)
{
  return GraphProblem(*this, 1, false).jointMarginal(poses, shouldStop);
}

std::map<ObjectId, Eigen::MatrixXd> FactorGraph::objectMarginals()
{
  return GraphProblem(*this, poses(), false).marginals(true).objects;
}

}  // namespace quadmap
