#pragma once

#include <Eigen/Dense>
#include <vector>

#include "quadmap/slam/points/PointTypes.h"

namespace quadmap
{
/** All poses of a robot and the objects it saw, estimated together: a pose graph whose landmarks
 * are points. Odometry binds each pose to the one before; the first one is fixed. */
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
  std::vector<PointOdometry<D>> steps;  //!< From pose k to pose k + 1: one less than poses
  std::vector<PointVector<D>> objects;
  std::vector<Sight> sights;
  bool posesFixed = false;  //!< Only the objects are estimated

  /** Brings poses and objects to the least cost.
   *  \param huber Sights farther off than this count linearly [sigmas], > 0.
   *  \return The cost: half the sum of squared residuals, robust. */
  double optimise(double huber, int maxIterations);

  /** Joint uncertainty of steps (shift, turn along the axes of the map) of poses and objects. */
  struct Marginals
  {
    std::vector<PoseStepMatrix<D>> pose;
    std::vector<Eigen::MatrixXd> poseObjects;  //!< Of each pose with all objects
    Eigen::MatrixXd objects;
  };
  /** At the current estimate, exactly (the chain of poses is eliminated one by one, and the
   * covariances are recovered backwards); sights count less as Huber's kernel has it. */
  Marginals marginals(double huber) const;
};

}  // namespace quadmap
