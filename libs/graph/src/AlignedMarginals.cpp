#include "GraphProblem.h"
#include "SparseInverse.h"
#include "quadmap/estimation/NormalEquations.h"
#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/RotationVector.h"

// How well a map knows where its objects are in it: (16.16) to (16.18) of doc/mathematics.md.
namespace quadmap
{
namespace
{
using SparseMatrix = Eigen::SparseMatrix<double>;

/** The rigid motion (turn w, shift t) that fits small moves of all positions best, d = t + w x (p -
 * centre), as the alignment of a trajectory finds it. */
struct TrajectoryMotion
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::MatrixXd perStep;  //!< 6 rows (w, t), a column for each unknown of the graph
};

TrajectoryMotion motionOf(
    const std::vector<Eigen::Vector3d>& positions,
    const std::vector<Eigen::Index>& columns,  // of each position's move; -1: it is fixed
    Eigen::Index unknowns)
{
  // Turns that no position shows (of a robot that stands, about its straight way) are left alone.
  constexpr double kLeastSpread = 0.05;  // [m]
  const auto count = static_cast<double>(positions.size());
  TrajectoryMotion motion;
  for (const auto& p : positions) motion.centre += p / count;
  Eigen::Matrix3d inertia = count * kLeastSpread * kLeastSpread * Eigen::Matrix3d::Identity();
  for (const auto& p : positions)
  {
    const Eigen::Matrix3d cross = crossMatrix(p - motion.centre);
    inertia -= cross * cross;
  }
  const Eigen::Matrix3d turnPerMoment = inertia.inverse();
  motion.perStep = Eigen::MatrixXd::Zero(6, unknowns);
  for (std::size_t k = 0; k < positions.size(); ++k)
  {
    if (columns[k] < 0) continue;
    motion.perStep.block<3, 3>(0, columns[k]) =
        turnPerMoment * crossMatrix(positions[k] - motion.centre);
    motion.perStep.block<3, 3>(3, columns[k]).diagonal().setConstant(1 / count);
  }
  return motion;
}

/** What a rigid motion of the whole map does to an upright object. */
Eigen::Matrix<double, 7, 6> changeByMotion(
    const Eigen::Vector3d& position, const Eigen::Vector3d& centre)
{
  Eigen::Matrix<double, 7, 6> change = Eigen::Matrix<double, 7, 6>::Zero();
  change.topLeftCorner<3, 3>() = -crossMatrix(position - centre);
  change.topRightCorner<3, 3>().setIdentity();
  change(3, 2) = 1;
  return change;
}

}  // namespace

std::map<ObjectId, UprightCovariance> GraphProblem::alignedObjectMarginals(std::size_t firstPose)
{
  std::map<ObjectId, UprightCovariance> marginals;
  const NormalMatrix normal = normalMatrix(kFreePositionSigma, kFreeAngleSigma);
  if (normal.poseAt.empty() || firstPose >= graph_.poses_.size()) return marginals;
  const Eigen::SimplicialLDLT<SparseMatrix> factorised(normal.H);
  if (factorised.info() != Eigen::Success || factorised.vectorD().minCoeff() <= 0) return marginals;
  const SparseInverse inverse(factorised);

  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Index> columns;
  for (std::size_t k = firstPose; k < graph_.poses_.size(); ++k)
  {
    positions.push_back(positionOf(graph_.pose(k)));
    const auto at = normal.poseAt.find(k);
    columns.push_back(at == normal.poseAt.end() ? -1 : at->second + 3);
  }
  const auto motion = motionOf(positions, columns, normal.H.rows());
  const Eigen::MatrixXd withMotion = factorised.solve(motion.perStep.transpose());
  const Eigen::MatrixXd ofMotion = motion.perStep * withMotion;
  for (const auto& [id, at] : normal.objectAt)
  {
    const auto& object = graph_.objects_.at(id);
    if (object.freedom != ObjectFreedom::Upright) continue;
    const Eigen::Map<const Eigen::Vector3d> position(object.block.data());
    const auto change = changeByMotion(position, motion.centre);
    const Eigen::MatrixXd cross = withMotion.middleRows(at, 7) * change.transpose();
    const UprightCovariance all =
        inverse.block(at, 7) - cross - cross.transpose() + change * ofMotion * change.transpose();
    marginals[id] = 0.5 * (all + all.transpose());
  }
  return marginals;
}

std::map<ObjectId, UprightCovariance> FactorGraph::alignedObjectMarginals(std::size_t firstPose)
{
  return GraphProblem(*this, 1, false).alignedObjectMarginals(firstPose);
}

}  // namespace quadmap
