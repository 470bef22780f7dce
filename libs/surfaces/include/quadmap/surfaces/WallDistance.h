#pragma once

#include <optional>

#include "quadmap/geometry/Plane.h"
#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
/** The wall behind a box and how far before it what the box shows is. */
struct WallDistance
{
  Plane wall;  //!< Optical frame, normal towards the camera
  double distance =
      0;  //!< Median of the depths in the middle of the box, from it to the camera [m]
};

/** \return Nothing when few depths in the middle of the box are near the wall, or most are not. */
std::optional<WallDistance> distanceFromWall(
    const DepthCloud& cloud, const DepthCloud::CellRange& box, const Plane& wall);

}  // namespace quadmap
