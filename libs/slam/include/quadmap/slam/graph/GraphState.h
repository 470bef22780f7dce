#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <array>
#include <memory>

#include "quadmap/maps/MapObject.h"

namespace ceres
{
class Manifold;
}

namespace quadmap
{
/** A pose as the optimiser keeps it: quaternion (x, y, z, w), then translation [m].
 * Steps have six numbers, (w, d) along the axes of the map: R' = exp(w) R, t' = t + d. */
using PoseBlock = std::array<double, 7>;

PoseBlock poseBlockOf(const mrpt::poses::CPose3D& T_map_robot);
mrpt::poses::CPose3D poseOf(const PoseBlock& block);

/** What an object may do. */
enum class ObjectFreedom
{
  Upright,  //!< Stands on a support: 7 numbers
  Free      //!< No support is known: 9
};

/** An object as the optimiser keeps it.
 * Upright: UprightState (x, y, z, yaw, ln a, ln b, ln c); the last three entries are not used.
 * Free: translation [m], quaternion (x, y, z, w), ln a, ln b, ln c; steps have nine numbers
 * (d, w, d ln s) with d and w along the axes of the map. */
using ObjectBlock = std::array<double, 10>;

ObjectBlock objectBlockOf(const Ellipsoid& object, ObjectFreedom freedom);
Ellipsoid objectOf(const ObjectBlock& block, ObjectFreedom freedom);

/** Numbers of a block, and of a step of it. */
constexpr int blockSize(ObjectFreedom f) { return f == ObjectFreedom::Upright ? 7 : 10; }
constexpr int stepSize(ObjectFreedom f) { return f == ObjectFreedom::Upright ? 7 : 9; }

/** The spaces these blocks live in; null for an upright object, whose space is flat. */
std::unique_ptr<ceres::Manifold> poseManifold();
std::unique_ptr<ceres::Manifold> objectManifold(ObjectFreedom freedom);

/** d(step)/d(quaternion) for a step R' = exp(w) R at q: how derivatives by rotation vectors become
 * derivatives by the quaternion's entries. */
Eigen::Matrix<double, 3, 4> rotationStepPerQuaternion(const Eigen::Quaterniond& q);

}  // namespace quadmap
