#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <array>
#include <memory>

#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/ObjectShape.h"

namespace ceres
{
class Manifold;
}

namespace quadmap
{
/** A pose as the optimiser keeps it: quaternion (x, y, z, w), then translation [m]. Its increments
 * have six numbers, (w, d) along the axes of the map: R' = exp(w) R, t' = t + d
 * (doc/mathematics.md, (16.1)). */
using PoseBlock = std::array<double, 7>;

PoseBlock poseBlockOf(const mrpt::poses::CPose3D& T_map_robot);
mrpt::poses::CPose3D poseOf(const PoseBlock& block);

/** An object as the optimiser keeps it.
 * Upright: UprightState (x, y, z, yaw, ln a, ln b, ln c); the last three entries are not used.
 * Free: translation [m], quaternion (x, y, z, w), ln a, ln b, ln c. Its increments have nine
 * numbers (d, w, d ln s), with d and w along the axes of the map. */
using ObjectBlock = std::array<double, 10>;

ObjectBlock objectBlockOf(const Ellipsoid& object, ObjectFreedom freedom);
Ellipsoid objectOf(const ObjectBlock& block, ObjectFreedom freedom);

/** The object of a block as the residuals see it. */
ObjectShape shapeOf(const double* block, ObjectFreedom freedom);

/** Numbers of a block, and of an increment of it. */
constexpr int blockSize(ObjectFreedom f) { return f == ObjectFreedom::Upright ? 7 : 10; }
constexpr int incrementSize(ObjectFreedom f) { return f == ObjectFreedom::Upright ? 7 : 9; }

/** The spaces these blocks live in; null for an upright object, whose space is flat. */
std::unique_ptr<ceres::Manifold> poseManifold();
std::unique_ptr<ceres::Manifold> objectManifold(ObjectFreedom freedom);

/** dw/dq of an increment R' = exp(w) R at q: it turns derivatives by rotation vectors into
 * derivatives by the quaternion's entries. */
Eigen::Matrix<double, 3, 4> rotationIncrementPerQuaternion(const Eigen::Quaterniond& q);

}  // namespace quadmap
