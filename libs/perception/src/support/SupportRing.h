#pragma once

#include <Eigen/Dense>
#include <vector>

#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/DepthCloud.h"
#include "quadmap/surfaces/ScenePlanes.h"
#include "support/SupportEvidence.h"

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

/** What of the surroundings of a box lies on a plane. */
struct RingEvidence
{
  double share = 0;                      //!< Of the valid depths
  std::vector<Eigen::Vector3d> surface;  //!< Points on it, outside the box
};

/** A point in the surroundings of a box. */
struct RingPoint
{
  Eigen::Vector3d point;
  double tolerance = 0;    //!< For lying on a plane [m]
  double noise = 0;        //!< Standard deviation of its depth [m]
  double nearest = 0;      //!< To the nearest horizontal plane that was seen there [m]
  bool onSurface = false;  //!< Outside the box, where the surface is smooth
  bool inBox = false;      //!< In the lowest tenth of the box: the support shows there, too
  bool lower = false;      //!< Below the middle of the box
  bool beside = true;      //!< No farther from the object than such a thing is large
};

/** The surroundings of a box: a ring around it, some hundred points. */
std::vector<RingPoint> ringAround(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    const PerceptionOptions& options);

/** Sets RingPoint::beside: the floor that shows past the edge of a table is around the box of what
 * stands there, but not around its foot. */
void findBeside(
    std::vector<RingPoint>& points,
    const RoughObject& object,
    const LabelProperties& label,
    const Eigen::Vector3d& up);

/** The share of the ring on a plane. A point near two horizontal planes counts for the nearer one
 * only. */
RingEvidence ringOn(const std::vector<RingPoint>& points, const Plane& plane, Ring ring);

}  // namespace quadmap
