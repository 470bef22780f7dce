#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <functional>
#include <optional>
#include <vector>

#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Follows the odometry from keyframe to keyframe. */
class OdometryMotion
{
 public:
  /** Goes on to the next keyframe.
   *  \param T_odom_robot Its pose as the odometry has it.
   *  \return The motion from the keyframe before; nothing for the first one. */
  std::optional<mrpt::poses::CPose3D> next(const mrpt::poses::CPose3D& T_odom_robot);

 private:
  std::optional<mrpt::poses::CPose3D> last_;
};

/** The same step, but nearly exact when the robot did not move: images of several cameras at one
 * moment have one pose. */
mrpt::poses::CPose3DPDFGaussian stiffAtRest(mrpt::poses::CPose3DPDFGaussian step);

/** Brings the poses of a graph nearest to those of the odometry, as a motion of the map. A graph
 * keeps its first pose, and the error of that one pose would move the whole map: all poses together
 * know better where it is, each in proportion to what the odometry still knows of it. */
mrpt::poses::CPose3D alignmentWithOdometry(
    const std::function<mrpt::poses::CPose3D(std::size_t)>& poseOf,
    const std::vector<Keyframe>& keyframes);

/** Gives the keyframes the poses of a graph. \return The farthest that one of them moved [m]. */
double movePoses(
    const mrpt::poses::CPose3D& T_map_graph,
    const std::function<mrpt::poses::CPose3D(std::size_t)>& poseOf,
    std::vector<Keyframe>& keyframes);

}  // namespace quadmap
