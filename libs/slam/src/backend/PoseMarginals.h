#pragma once

#include <vector>

#include "quadmap/graph/FactorGraph.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Covariance of (x, y, z, yaw, pitch, roll) from that of a pose block's step (w, d).
 * \return Nothing where the robot looks straight up or down: there yaw and roll are one. */
std::optional<mrpt::math::CMatrixDouble66> covarianceOfPose(
    const mrpt::poses::CPose3D& T_map_robot, const Eigen::Matrix<double, 6, 6>& covarianceOfStep);

/** Notes the marginal covariances of the poses of a graph, at its present estimate, at the
 * keyframes, which are its last ones. */
void noteMarginals(FactorGraph& graph, std::vector<Keyframe>& keyframes);

}  // namespace quadmap
