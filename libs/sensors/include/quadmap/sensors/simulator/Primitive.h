#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <optional>

namespace quadmap::simulator
{
enum class Shape
{
  Box,
  Cylinder,  //!< Elliptic, its axis is z
  Ellipsoid
};

/** One solid of an object. Frame `prim`: origin at the centre, axes along the half sizes. */
struct Primitive
{
  Shape shape = Shape::Box;
  mrpt::poses::CPose3D T_obj_prim;
  Eigen::Vector3d halfSize = Eigen::Vector3d(0.5, 0.5, 0.5);  //!< [m], > 0
  std::size_t material = 0;                                   //!< Index into Scene::materials
};

/** Where the ray o + t d (in `prim`, t > 0, d of any length) enters the solid, as t. A ray that
 * starts inside has no entry. */
std::optional<double> intersect(
    const Primitive& primitive, const Eigen::Vector3d& o, const Eigen::Vector3d& d);

/** Unit normal, outwards, at a point of the surface; all in `prim`. */
Eigen::Vector3d surfaceNormal(const Primitive& primitive, const Eigen::Vector3d& p);

/** Half lengths of the tight box of the solid along the axes of `obj`, around its centre [m]. */
Eigen::Vector3d halfExtent(const Primitive& primitive);

}  // namespace quadmap::simulator
