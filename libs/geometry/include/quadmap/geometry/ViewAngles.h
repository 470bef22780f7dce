#pragma once

#include <Eigen/Dense>
#include <vector>

namespace quadmap
{
/** Largest angle between the rays from two of the cameras to a point [rad]; 0 for fewer than two
 * cameras. */
double parallax(const Eigen::Vector3d& point, const std::vector<Eigen::Vector3d>& cameras);

/** Distance at which an object of a size fills the angle between two planes through the camera that
 * face each other [m]: doc/mathematics.md, (11.11). It is (17.6) before it is bounded.
 * \param size Full length of the object from plane to plane [m].
 * \param n_a, n_b The planes' unit normals, both towards the object. */
double rangeThatFills(double size, const Eigen::Vector3d& n_a, const Eigen::Vector3d& n_b);

}  // namespace quadmap
