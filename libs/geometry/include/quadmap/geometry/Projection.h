#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/geometry/ImageBox.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/geometry/Plane.h"

namespace quadmap
{
/** Dual conic C* = K [I|0] Q* [I|0]^t K^t of the outline of an ellipsoid given in `optical`. */
Eigen::Matrix3d projectDualConic(const PinholeCamera& camera, const Ellipsoid& object_optical);

/** Axis-aligned box of the outline of an ellipsoid, not clipped to the image [px].
 * \return Nothing when the object is not entirely in front of the camera plane (behind it, cut by
 * it, or with the camera inside). */
std::optional<ImageBox> projectEllipsoidBox(
    const PinholeCamera& camera, const Ellipsoid& object_optical);

/** Axis-aligned box of the projected circumscribed cuboid: of its part at least `nearPlane` [m]
 * in front of the camera, not clipped to the image [px].
 * \return Nothing when no part of it is. */
std::optional<ImageBox> projectCuboidBox(
    const PinholeCamera& camera, const Ellipsoid& object_optical, double nearPlane = 0.05);

/** Edges of an image box, in the order used everywhere. */
enum class BoxEdge
{
  Left = 0,
  Top,
  Right,
  Bottom
};

/** The plane through the camera centre and one edge of a box, in `optical`, normal towards the
 * inside of the box. Right for negative fy too. */
Plane boxEdgePlane(const PinholeCamera& camera, const ImageBox& box, BoxEdge edge);

/** All four, in the order of BoxEdge. */
std::array<Plane, 4> boxEdgePlanes(const PinholeCamera& camera, const ImageBox& box);

}  // namespace quadmap
