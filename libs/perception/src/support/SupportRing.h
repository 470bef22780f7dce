#pragma once

#include <Eigen/Dense>
#include <vector>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
/** Where the surroundings of a box are taken from. */
enum class Ring
{
  LowerHalf,  //!< Beside and under the lower half: what shows a horizontal support
  All         //!< All around: what shows a wall
};

/** Down in the image at the middle of a box, unit; a camera may be mounted any way round. */
Eigen::Vector2d downInImage(
    const PinholeCamera& camera, const Eigen::Vector3d& up, const ImageBox& box);

/** A point in the surroundings of a box. */
struct RingPoint
{
  Eigen::Vector3d point;
  double tolerance = 0;  //!< For lying on a plane [m]
  bool lower = false;    //!< Below the middle of the box
};

/** The surroundings of a box: a ring around it, some hundred points. */
std::vector<RingPoint> ringAround(
    const DepthCloud& cloud,
    const Eigen::Vector3d& up,
    const ImageBox& box,
    const PerceptionOptions& options);

/** The share of the ring on a plane, in [0, 1]. */
double shareOn(const std::vector<RingPoint>& points, const Plane& plane, Ring ring);

}  // namespace quadmap
