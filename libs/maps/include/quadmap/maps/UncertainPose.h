#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "quadmap/estimation/ObjectView.h"

namespace quadmap
{
/** A robot pose in the map and what it errs by, the same in all directions. */
struct UncertainPose
{
  /** \param error Standard deviations of the pose; PoseNoise{0, 0} for an exact one. */
  UncertainPose(const mrpt::poses::CPose3D& T_map_robot, const PoseNoise& error);

  /** Takes the root mean square over the three directions, of the moves [m] and of the turns [rad],
   * from MRPT's covariance of (x, y, z, yaw, pitch, roll). Correlations between moves and turns are
   * not used. */
  UncertainPose(const mrpt::poses::CPose3DPDFGaussian& T_map_robot);

  mrpt::poses::CPose3D mean;  //!< T_map_robot
  PoseNoise error;            //!< Of the mean
};

/** The standard deviations of two independent errors together. */
PoseNoise combined(const PoseNoise& a, const PoseNoise& b);

}  // namespace quadmap
