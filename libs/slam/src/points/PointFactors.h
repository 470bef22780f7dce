#pragma once

#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <array>
#include <memory>

#include "quadmap/slam/points/PointGraph.h"

namespace quadmap
{
/** A pose as the optimiser keeps it: (x, y [m], angle [rad]) in the plane; a PoseBlock in space. */
template <int D>
using PointPoseBlock = std::array<double, D == 2 ? 3 : 7>;

template <int D>
PointPoseBlock<D> pointBlockOf(const PointPose<D>& pose);
template <int D>
PointPose<D> pointPoseOf(const PointPoseBlock<D>& block);
/** Null for poses in the plane, whose space is flat. */
template <int D>
std::unique_ptr<ceres::Manifold> pointPoseManifold();

/** r = W (R^t (l - t) - z). Blocks: pose, object. */
template <int D>
std::unique_ptr<ceres::CostFunction> createSightFactor(const typename PointGraph<D>::Sight& sight);

/** r = W [R_f^t (t_t - t_f) - t_m; log(R_m^t R_f^t R_t)]. Blocks: poses `from`, `to`. */
template <int D>
std::unique_ptr<ceres::CostFunction> createPointStepFactor(const PointOdometry<D>& step);

}  // namespace quadmap
