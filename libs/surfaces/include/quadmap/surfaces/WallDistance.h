#pragma once

#include <optional>

#include "quadmap/geometry/Plane.h"
#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
/** May a thing hang on a wall whose middle is this far before it [m]? Noise may put it behind. */
inline bool mayHangOnWall(double distance) { return distance > -0.05 && distance < 0.3; }

/** The wall behind a box and how far before it what the box shows is. */
struct WallDistance
{
  Plane wall;                  //!< Optical frame, normal towards the camera
  double distance = 0;         //!< Median of the middle of the box, from the wall, at least 0 [m]
  double headingSigma = 0.01;  //!< Of the wall [rad]; that of a wall of many points
};

/** \return Nothing when few depths in the middle of the box are on the wall or before it, no
 * farther than what hangs there, or most are not. */
std::optional<WallDistance> distanceFromWall(
    const DepthCloud& cloud, const DepthCloud::CellRange& box, const Plane& wall);

}  // namespace quadmap
