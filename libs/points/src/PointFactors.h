#pragma once

#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <array>
#include <memory>

#include "PointGraph.h"

namespace quadmap
{
/** A pose as the optimiser has it: (x, y [m], angle [rad]) in the plane, and a PoseBlock in space.
 */
template <int D>
using PointPoseBlock = std::array<double, D == 2 ? 3 : 7>;

template <int D>
PointPoseBlock<D> pointBlockOf(const PointPose<D>& pose);
template <int D>
PointPose<D> pointPoseOf(const PointPoseBlock<D>& block);
/** The manifold of poses. It is null in the plane, where poses are a vector space. */
template <int D>
std::unique_ptr<ceres::Manifold> pointPoseManifold();

/** Measurement of a point, r = W (R^t (l - t) - z): doc/mathematics.md, (18.1). The blocks are pose
 * and object. */
template <int D>
std::unique_ptr<ceres::CostFunction> createSightFactor(const typename PointGraph<D>::Sight& sight);

/** Odometry, r = W [R_f^t (t_t - t_f) - t_m; log(R_m^t R_f^t R_t)]: doc/mathematics.md, (16.2). The
 * blocks are the poses `from` and `to`. */
template <int D>
std::unique_ptr<ceres::CostFunction> createPointStepFactor(const PointOdometry<D>& step);

/** Residuals of a measurement of a point [sigmas], and their derivatives by the increments of the
 * pose and by the object. */
template <int D>
struct LinearisedSight
{
  PointVector<D> r;
  Eigen::Matrix<double, D, kPoseIncrement<D>> byPose;
  PointMatrix<D> byObject;
};

template <int D>
LinearisedSight<D> linearised(
    const typename PointGraph<D>::Sight& sight,
    const PointPose<D>& pose,
    const PointVector<D>& object);

/** Derivatives of an odometry residual [sigmas] by the increments of its two poses. */
template <int D>
struct LinearisedStep
{
  PoseIncrementMatrix<D> byFrom, byTo;
};

template <int D>
LinearisedStep<D> linearised(
    const PointOdometry<D>& step, const PointPose<D>& from, const PointPose<D>& to);

}  // namespace quadmap
