#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/RotationVector.h"
#include "quadmap/slam/graph/FactorGraph.h"

namespace quadmap
{
namespace
{
using Eigen::Vector3d;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kLeast = 1e-6;  // information of what is unknown [1/m^2], [1/rad^2]

/** What the views of one pose want of one object, along the axes of the map. */
struct Pull
{
  Vector3d force = Vector3d::Zero();   // gradient by a move of the object [1/m]
  Vector3d torque = Vector3d::Zero();  // ... and by a turn of it about its centre [1/rad]
  double stiffness = 0;                // mean information of its position [1/m^2]
  double turnStiffness = 0;            // ... and of its orientation [1/rad^2]

  /** \param r, perStep Residuals of a view and their derivatives by (w, d) of the robot.
   *  \param lever From the robot to the object's centre [m]. */
  void add(const Eigen::VectorXd& r, const RowMajor& perStep, const Vector3d& lever)
  {
    for (Eigen::Index i = 0; i < r.size(); ++i)
    {
      // Only the relative pose counts: the object moves against the robot.
      const Vector3d perMove = -perStep.row(i).tail<3>().transpose();
      const Vector3d perTurn = -perStep.row(i).head<3>().transpose() - lever.cross(perMove);
      force += r[i] * perMove;
      torque += r[i] * perTurn;
      stiffness += perMove.squaredNorm() / 3;
      turnStiffness += perTurn.squaredNorm() / 3;
    }
  }

  /** The object where the pull would bring it to. */
  mrpt::poses::CPose3D follow(const Ellipsoid& at) const
  {
    Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
    T.topLeftCorner<3, 3>() =
        rotationOf(-torque / std::max(kLeast, turnStiffness)).toRotationMatrix() * at.rotation();
    T.topRightCorner<3, 1>() = at.center() - force / std::max(kLeast, stiffness);
    return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T));
  }
};

}  // namespace

std::vector<FactorGraph::PoseEdge> FactorGraph::poseEdges() const
{
  const auto manifold = poseManifold();
  std::vector<PoseEdge> edges;
  for (std::size_t k = 0; k < poses_.size(); ++k)
  {
    const mrpt::poses::CPose3D T_map_robot = pose(k);
    const Vector3d robot(T_map_robot.x(), T_map_robot.y(), T_map_robot.z());
    RowMajor plus(7, 6);
    manifold->PlusJacobian(poses_[k].data(), plus.data());
    std::map<ObjectId, Pull> pulls;
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
      pulls[view.object].add(r, J * plus, object(view.object).center() - robot);
    }
    for (const auto& [id, pull] : pulls)
      edges.push_back(
          {k, id, pull.follow(object(id)) - T_map_robot, std::max(kLeast, pull.stiffness),
           std::max(kLeast, pull.turnStiffness)});
  }
  return edges;
}

}  // namespace quadmap
