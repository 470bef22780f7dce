#pragma once

#include <Eigen/Dense>

namespace quadmap
{
/** The smallest rotation between two sets of axes whose names are arbitrary. */
struct SymmetricRotation
{
  double angle = 0;            //!< [rad], in [0, pi]
  Eigen::Matrix3d relabeling;  //!< Signed permutation P: R_b * P is the closest to R_a
};

/** Smallest rotation between the axes of two cuboids, over the 24 proper relabelings of the axes of
 * b: doc/mathematics.md, (20.4). */
SymmetricRotation symmetricRotationDistance(const Eigen::Matrix3d& R_a, const Eigen::Matrix3d& R_b);

/** Smallest absolute difference of two yaws that are equal modulo `period` [rad]. The result is in
 * [0, period/2]. */
double yawDistance(double yawA, double yawB, double period = M_PI / 2);

/** How many quarter turns, to the left, bring `yaw` nearest to `reference`: by an odd number of
 * them x and y of a cuboid change their names. */
int quarterTurnsTo(double yaw, double reference);

/** The representative of `yaw` modulo `period` that is nearest to `reference` [rad]. */
double nearestEquivalentYaw(double yaw, double reference, double period = M_PI / 2);

}  // namespace quadmap
