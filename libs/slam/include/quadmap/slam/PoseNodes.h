#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <vector>

#include "quadmap/slam/PoseUncertainty.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** One pose of the robot, and the images that were taken from it. */
struct PoseNode
{
  double time = 0;  //!< Of the first image [s]
  mrpt::poses::CPose3D T_map_robot;
  mrpt::poses::CPose3D T_odom_robot;
  std::vector<std::size_t> keyframes;  //!< Indices, in the order of time; each of another sensor
};

/** The keyframes in the order of time, those of several cameras on a robot that stood still (or
 * with one time stamp) as one node: everything written about poses speaks of these. Cameras that
 * took their images one after the other on a moving robot saw from different poses and stay apart.
 */
std::vector<PoseNode> poseNodesOf(const std::vector<Keyframe>& keyframes);

/** The nodes' poses with their covariances: those of the estimation where it has them for all, else
 * those of `chain`. */
std::vector<mrpt::poses::CPose3DPDFGaussian> poseDistributions(
    const std::vector<PoseNode>& nodes,
    const std::vector<Keyframe>& keyframes,
    PoseCovarianceChain chain);

/** The index of its node, for each keyframe. */
std::vector<std::size_t> nodeOfEachKeyframe(const std::vector<PoseNode>& nodes);

}  // namespace quadmap
