#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <vector>

#include "quadmap/geometry/Plane.h"

namespace quadmap
{
enum class SurfaceKind
{
  Floor,       //!< Horizontal, with nothing under it
  Horizontal,  //!< Table tops, seats, shelves
  Wall         //!< Vertical
};

/** A flat surface of the room and where on it something was seen. Which frame, its owner says. */
struct SurfacePatch
{
  SurfaceKind kind = SurfaceKind::Horizontal;
  Plane plane;  //!< Normal up, or into the room
  /** Points on it, some centimetres apart [m]. A floor may have none: it goes on everywhere. */
  std::vector<Eigen::Vector3f> samples;
  bool isFurniture = false;  //!< A table top or the like: something is under it, or it is in a box
};

/** The point of frame b expressed in frame a. */
Eigen::Vector3f transformed(const Eigen::Vector3f& p_b, const mrpt::poses::CPose3D& T_a_b);

/** The patch of frame b expressed in frame a. */
SurfacePatch transformed(const SurfacePatch& patch_b, const mrpt::poses::CPose3D& T_a_b);

/** What one frame says about the surfaces of the room, in the sensor frame. */
struct FrameSurfaces
{
  std::vector<SurfacePatch> seen;
  std::vector<Eigen::Vector3f> seenThrough;  //!< Samples of known surfaces that are not there [m]
  bool contradictsFloor = false;  //!< The known floor is not there: things were seen below it
};

}  // namespace quadmap
