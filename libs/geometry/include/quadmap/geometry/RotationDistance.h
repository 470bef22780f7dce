#pragma once

#include <Eigen/Dense>

namespace quadmap
{
struct SymmetricRotation
{
  double angle = 0;            //!< [rad], in [0, pi]
  Eigen::Matrix3d relabeling;  //!< Signed permutation P: R_b * P is the closest to R_a
};

/** Smallest rotation between two boxes' axes over the 24 proper relabelings of b's axes. */
SymmetricRotation symmetricRotationDistance(const Eigen::Matrix3d& R_a, const Eigen::Matrix3d& R_b);

/** Smallest |difference| of two yaws that mean the same every `period` [rad]; result in
 * [0, period/2]. */
double yawDistance(double yawA, double yawB, double period = M_PI / 2);

/** The representative of `yaw` modulo `period` that is nearest to `reference` [rad]. */
double nearestEquivalentYaw(double yaw, double reference, double period = M_PI / 2);

}  // namespace quadmap
