#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <map>

#include "quadmap/geometry/PosePosition.h"
#include "quadmap/graph/FactorGraph.h"

namespace quadmap
{
namespace
{
using Eigen::Vector3d;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kLeast = 1e-6;  // information of what is unknown [1/m^2], [1/rad^2]

/** Adds what a view of an object knows of its pose relative to the robot's, given the object's
 * size. \param perStep Derivatives of its residuals by the increments (w, d) of the robot. \param
 * lever From the robot to the object's centre [m]. */
void addInformation(const RowMajor& perStep, const Vector3d& lever, FactorGraph::GraphEdge& edge)
{
  for (Eigen::Index i = 0; i < perStep.rows(); ++i)
  {
    // Only the relative pose counts: the object moves against the robot.
    const Vector3d perMove = -perStep.row(i).tail<3>().transpose();
    const Vector3d perTurn = -perStep.row(i).head<3>().transpose() - lever.cross(perMove);
    edge.positionInformation += perMove.squaredNorm() / 3;
    edge.angleInformation += perTurn.squaredNorm() / 3;
  }
}

}  // namespace

std::vector<FactorGraph::GraphEdge> FactorGraph::graphEdges() const
{
  const auto manifold = poseManifold();
  std::vector<GraphEdge> edges;
  for (std::size_t k = 0; k < poses_.size(); ++k)
  {
    const Vector3d robot = positionOf(pose(k));
    RowMajor plus(7, 6);
    manifold->PlusJacobian(poses_[k].data(), plus.data());
    std::map<ObjectId, GraphEdge> edgeTo;
    for (const View& view : viewsByPose_[k])
    {
      if (!hasObject(view.object)) continue;
      const Object& vertex = objects_.at(view.object);
      const auto factor = createViewFactor(
          view.view, vertex.label.shapeExponent, options_.estimator.huber, vertex.freedom);
      Eigen::VectorXd r(factor->num_residuals());
      RowMajor J(factor->num_residuals(), 7);
      const double* blocks[] = {poses_[k].data(), vertex.block.data()};
      double* jacobians[] = {J.data(), nullptr};
      factor->Evaluate(blocks, r.data(), jacobians);
      const auto edge = edgeTo.try_emplace(view.object, GraphEdge{k, view.object, kLeast, kLeast});
      addInformation(J * plus, object(view.object).center() - robot, edge.first->second);
    }
    for (const auto& [id, edge] : edgeTo) edges.push_back(edge);
  }
  return edges;
}

}  // namespace quadmap
