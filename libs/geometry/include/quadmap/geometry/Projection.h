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
/** Dual conic C* = K [I|0] Q* [I|0]^t K^t of the outline of an ellipsoid in `optical`:
 * doc/mathematics.md, (2.1). */
Eigen::Matrix3d projectDualConic(const PinholeCamera& camera, const Ellipsoid& object_optical);

/** Axis-aligned box of the outline of an ellipsoid, not clipped to the image [px]: the ends (2.2)
 * of the conic (2.1) of doc/mathematics.md. \return Nothing when the object is not entirely in
 * front of the camera plane, because it is behind it, is cut by it, or has the camera inside. */
std::optional<ImageBox> projectEllipsoidBox(
    const PinholeCamera& camera, const Ellipsoid& object_optical);

/** Axis-aligned box of the projected circumscribed cuboid, not clipped to the image [px]. Only the
 * part of the cuboid counts that is at least `nearPlane` [m] in front of the camera.
 * \return Nothing when no part of the cuboid is. */
std::optional<ImageBox> projectCuboidBox(
    const PinholeCamera& camera, const Ellipsoid& object_optical, double nearPlane = 0.05);

/** Edges of an image box, in the order in which arrays of edges have them. */
enum class BoxEdge
{
  Left = 0,
  Top,
  Right,
  Bottom
};

/** The plane through the camera centre and one edge of a box, in `optical`, with its normal towards
 * the inside of the box: doc/mathematics.md, (2.4). It is right for a negative fy too. */
Plane boxEdgePlane(const PinholeCamera& camera, const ImageBox& box, BoxEdge edge);

/** The planes of all four edges, in the order of BoxEdge. */
std::array<Plane, 4> boxEdgePlanes(const PinholeCamera& camera, const ImageBox& box);

/** Does a face with this outward normal look out over an edge of a box? Only such a face can end at
 * the edge. \param edge One of boxEdgePlanes(), in the frame of the normal. */
inline bool looksOver(const Plane& edge, const Eigen::Vector3d& normal)
{
  constexpr double kMinCosine = 0.25;  // between the normal and the outside
  return -edge.n.dot(normal) > kMinCosine;
}

/** Whether a box edge is an upper one: the direction out of the box over it is within 45 degrees of
 * up. \param edge Its plane, normal towards the object. \param up Unit, in the frame of the plane.
 */
inline bool isUpperEdge(const Plane& edge, const Eigen::Vector3d& up)
{
  constexpr double kMinCosine = 0.7;
  return -edge.n.dot(up) > kMinCosine;
}

}  // namespace quadmap
