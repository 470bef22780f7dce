#pragma once

#include <ceres/cost_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>

#include <Eigen/Sparse>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "FloorGroups.h"
#include "quadmap/graph/FactorGraph.h"

namespace quadmap
{
/** How much a view knows of the bottom of its object [1/m^2]. */
double bottomInformation(const BoxMeasurement& view);

/** The free part of a graph as a problem for Ceres. It works on the graph's own blocks. */
class GraphProblem
{
 public:
  /** \param folded True: folded views enter as their object's Gaussian. False: each enters itself.
   */
  GraphProblem(FactorGraph& graph, std::size_t firstFree, bool folded);

  FactorGraph::Summary solve();
  FactorGraph::Marginals marginals(bool withObjects);
  std::vector<Eigen::Matrix<double, 6, 6>> poseMarginals();
  std::optional<Eigen::MatrixXd> jointMarginal(
      const std::vector<std::size_t>& poses, const std::function<bool()>& shouldStop);
  std::map<ObjectId, UprightCovariance> alignedObjectMarginals(std::size_t firstPose);
  FactorGraph::WindowFit windowFit(std::pair<std::size_t, std::size_t> steps);
  StepFit stepFit();

 private:
  using SparseMatrix = Eigen::SparseMatrix<double>;
  /** Lower triangle of H of steps of the free blocks, and where theirs begin. */
  struct NormalMatrix
  {
    SparseMatrix H;
    std::map<std::size_t, Eigen::Index> poseAt;
    std::map<ObjectId, Eigen::Index> objectAt;
  };
  /** Do steps and views of common objects join each pose to pose 0, directly or by others? What is
   * known of an object from elsewhere joins it to pose 0, too: that is where it was told. */
  bool isInOnePiece() const;
  /** \param positionSigma, angleSigma Of each object from elsewhere [m], [rad]. */
  NormalMatrix normalMatrix(double positionSigma, double angleSigma);
  /** Rows and columns of H^-1 from these on, of two poses. */
  using JointCovariance =
      std::function<Eigen::Matrix<double, 6, 6>(Eigen::Index row, Eigen::Index column)>;
  StepFit stepFit(
      const NormalMatrix& normal,
      const JointCovariance& covariance,
      std::pair<std::size_t, std::size_t> steps) const;

  void addFloors();
  double* floorBlock(double height);
  StandingThing standingThing(ObjectId id) const;
  HeightDrift heightDrift() const;
  void addStep(const FactorGraph::Step& step);
  void addView(std::size_t pose, const FactorGraph::View& view);
  double* poseBlock(std::size_t index);
  double* objectBlock(ObjectId id);

  FactorGraph& graph_;
  std::size_t firstFree_;
  bool folded_;
  std::size_t firstView_;  // pose; earlier views are folded
  std::unique_ptr<ceres::Manifold> poseManifold_, freeManifold_;
  ceres::Problem problem_;
  std::map<std::size_t, double*> poses_;  // in the problem
  std::map<ObjectId, double*> objects_;
  std::map<ObjectId, std::vector<std::pair<std::size_t, const BoxMeasurement*>>>
      views_;                    // and poses
  std::vector<double*> floors_;  // in the problem: their heights
};

}  // namespace quadmap
