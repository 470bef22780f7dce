#include "quadmap/maps/UncertainPose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "quadmap/geometry/PoseAngles.h"

namespace quadmap
{
UncertainPose::UncertainPose(const mrpt::poses::CPose3D& T_map_robot, const PoseNoise& noise) :
    mean(T_map_robot), error(noise)
{
}

UncertainPose::UncertainPose(const mrpt::poses::CPose3DPDFGaussian& T_map_robot) :
    mean(T_map_robot.mean)
{
  const Eigen::Matrix<double, 6, 6> S = T_map_robot.cov.asEigen();
  const Eigen::Matrix3d J = localTurnsPerAngle(mean);
  const Eigen::Matrix3d turns = J * S.bottomRightCorner<3, 3>() * J.transpose();
  error.position = std::sqrt(S.diagonal().head<3>().mean());
  error.angle = std::sqrt(std::max(0.0, turns.trace() / 3));
}

PoseNoise combined(const PoseNoise& a, const PoseNoise& b)
{
  PoseNoise noise;
  noise.position = std::hypot(a.position, b.position);
  noise.angle = std::hypot(a.angle, b.angle);
  return noise;
}

}  // namespace quadmap
