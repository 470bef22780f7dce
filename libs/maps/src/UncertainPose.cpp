#include "quadmap/maps/UncertainPose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
/** The turn about the robot's axes that small changes of (yaw, pitch, roll) make, of an orientation
 * R = Rz(yaw) Ry(pitch) Rx(roll). */
Eigen::Matrix3d turnsOfAngles(double pitch, double roll)
{
  const double cp = std::cos(pitch), sp = std::sin(pitch), cr = std::cos(roll), sr = std::sin(roll);
  Eigen::Matrix3d J;
  J << -sp, 0, 1,      //
      cp * sr, cr, 0,  //
      cp * cr, -sr, 0;
  return J;
}

}  // namespace

UncertainPose::UncertainPose(const mrpt::poses::CPose3D& T_map_robot, const PoseNoise& noise) :
    mean(T_map_robot), error(noise)
{
}

UncertainPose::UncertainPose(const mrpt::poses::CPose3DPDFGaussian& T_map_robot) :
    mean(T_map_robot.mean)
{
  const Eigen::Matrix<double, 6, 6> S = T_map_robot.cov.asEigen();
  const Eigen::Matrix3d J = turnsOfAngles(mean.pitch(), mean.roll());
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
