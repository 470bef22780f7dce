#pragma once

#include <Eigen/Dense>
#include <deque>
#include <vector>

#include "quadmap/estimation/Visibility.h"

namespace quadmap
{
/** Views of one object from nearly the same place repeat each other's mistakes: n of them,
 * perfectly correlated, know as much as one. The share of its information that each of them may
 * claim (doc/mathematics.md, (16.20)),
 *
 *   1 / (1 + rho * sum over the others of k_ij),   k_ij = max(0, 1 - d_ij / (range * angle)),
 *
 * with d_ij the distance of the cameras, `angle` the independentViewAngle and rho = 1 -
 * repeatedViewWeight of ExistenceOptions. */
std::vector<double> independentShares(
    const std::vector<Eigen::Vector3d>& cameras,
    const Eigen::Vector3d& center,
    const ExistenceOptions& options);

/** Distance of a camera from another one beyond which its mistakes are others [m]. It is the
 * independentViewAngle as seen from the object's `center`. */
double independentReach(
    const Eigen::Vector3d& camera, const Eigen::Vector3d& center, const ExistenceOptions& options);

/** k of (16.20), how much of their mistakes two cameras share, in [0, 1]. \param reach Of one of
 * them [m]. */
double sharedMistakes(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double reach);

/** The share of (16.20) and (13.1). \param crowd Sum of k over the others. */
double independentShare(double crowd, const ExistenceOptions& options);

/** The same for one more view, given earlier ones. */
double independentShare(
    const Eigen::Vector3d& camera,
    const Eigen::Vector3d& center,
    const std::deque<Eigen::Vector3d>& earlier,
    const ExistenceOptions& options);

/** Keeps the latest places only, so that the cost of a view does not grow with the run. */
void rememberCamera(const Eigen::Vector3d& camera, std::deque<Eigen::Vector3d>& cameras);

}  // namespace quadmap
