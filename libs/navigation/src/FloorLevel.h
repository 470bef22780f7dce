#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>

#include "quadmap/surfaces/SurfacePatch.h"

namespace quadmap
{
/** By which tilt the odometry errs, from the floor as the images show it: doc/mathematics.md,
 * (14.8). */
class FloorLevel
{
 public:
  /** \param share Of the tilt of a floor that is taken out at once, in [0, 1]. */
  explicit FloorLevel(double share) : share_(share) {}

  /** The pose of the robot with the tilt taken out; its position stays. */
  mrpt::poses::CPose3D levelled(const mrpt::poses::CPose3D& T_odom_robot) const;

  /** \param seen What a frame shows, in the sensor's frame; without a floor it changes nothing.
   *  \param T_level_sensor The sensor's pose by levelled(). */
  void look(const FrameSurfaces& seen, const mrpt::poses::CPose3D& T_level_sensor);

 private:
  double share_;
  Eigen::Matrix3d R_level_odom_ = Eigen::Matrix3d::Identity();
};

}  // namespace quadmap
