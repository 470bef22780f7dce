#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <vector>

#include "quadmap/odometry/PoseUncertainty.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** One pose of the robot, and the images that were taken from it. */
struct PoseNode
{
  double time = 0;  //!< Time of the first image [s]
  mrpt::poses::CPose3D T_map_robot;
  mrpt::poses::CPose3D T_odom_robot;
  std::vector<std::size_t> keyframes;  //!< Indices in the order of time, one per sensor
};

/** Groups the keyframes into nodes, in the order of time. Keyframes of several cameras make one
 * node when the robot stood still or when they have one time stamp. Cameras that took their images
 * one after the other on a moving robot had different poses, and make nodes of their own. All files
 * of a run that contain poses have one pose per node. */
std::vector<PoseNode> poseNodesOf(const std::vector<Keyframe>& keyframes);

/** The poses of the nodes with their covariances. The covariances are those of the estimation when
 * it has them for all nodes, and those of `chain` otherwise. */
std::vector<mrpt::poses::CPose3DPDFGaussian> poseDistributions(
    const std::vector<PoseNode>& nodes,
    const std::vector<Keyframe>& keyframes,
    PoseCovarianceChain chain);

/** For each keyframe the index of its node. */
std::vector<std::size_t> nodeOfEachKeyframe(const std::vector<PoseNode>& nodes);

}  // namespace quadmap
