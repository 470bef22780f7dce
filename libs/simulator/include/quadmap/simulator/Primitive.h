#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <optional>

namespace quadmap::simulator
{
enum class Shape
{
  Box,
  Cylinder,  //!< Elliptic, with z as its axis
  Ellipsoid
};

/** One solid of an object. Its frame `prim` has the origin at the centre and its axes along the
 * half sizes. */
struct Primitive
{
  Shape shape = Shape::Box;
  mrpt::poses::CPose3D T_obj_prim;
  Eigen::Vector3d halfSize = Eigen::Vector3d(0.5, 0.5, 0.5);  //!< [m], > 0
  std::size_t material = 0;                                   //!< Index into Scene::materials
};

/** The parameter t at which the ray o + t d enters the solid, or nothing when it does not. The ray
 * is in `prim`, t > 0, and d has any length. A ray that starts inside does not enter. */
std::optional<double> intersect(
    const Primitive& primitive, const Eigen::Vector3d& o, const Eigen::Vector3d& d);

/** Outward unit normal at a point p of the surface, both in `prim`. */
Eigen::Vector3d surfaceNormal(const Primitive& primitive, const Eigen::Vector3d& p);

/** Half sizes of the tight cuboid around the solid along the axes of `obj` [m]. */
Eigen::Vector3d halfExtent(const Primitive& primitive);

}  // namespace quadmap::simulator
