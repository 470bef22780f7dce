#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "quadmap/points/PointTypes.h"

namespace quadmap
{
/** A pose graph whose landmarks are points. It estimates all poses of a robot and the objects that
 * it saw together. Odometry ties each pose to the one before. The first pose is fixed. */
template <int D>
class PointGraph
{
 public:
  struct Sight
  {
    std::size_t pose = 0, object = 0;
    PointVector<D> position;    //!< In the robot's frame [m]
    PointMatrix<D> covariance;  //!< [m^2]
  };

  std::vector<PointPose<D>> poses;
  std::vector<PointOdometry<D>> steps;  //!< Step k leads from pose k to pose k + 1
  std::vector<PointVector<D>> objects;
  std::vector<Sight> sights;
  bool posesFixed = false;  //!< Only the objects are estimated

  /** Brings poses and objects to the least cost.
   *  \param huber Threshold of Huber's kernel on sights [sigmas], > 0.
   *  \return The cost, half the sum of squared residuals under the kernel. */
  double optimise(double huber, int maxIterations);

  /** Covariance of increments (shift, turn along the axes of the map) of one pose, and its cross
   * covariance with those of all objects. */
  struct PoseMarginal
  {
    PoseIncrementMatrix<D> pose;
    Eigen::MatrixXd poseObjects;
  };
  /** Is told the marginals of a pose and of the objects. \return False when it needs no more. */
  using PoseVisitor = std::function<bool(
      std::size_t pose, const PoseMarginal& marginal, const Eigen::MatrixXd& objects)>;

  /** Exact marginal covariances at the current estimate: doc/mathematics.md, section 18. The poses
   * are eliminated one by one, and their covariances are recovered backwards. Sights have the
   * weights of Huber's kernel. The memory grows with the number of objects times the square root of
   * the number of poses.
   * \param visit Is called for each pose, from the last one to the first.
   * \return Covariance of all objects. */
  Eigen::MatrixXd marginals(double huber, const PoseVisitor& visit = {}) const;
};

}  // namespace quadmap
