#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "DepthCloud.h"
#include "ScenePlanes.h"
#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** What a box shows of its object before it is cut out: points off the surfaces that reach far
 * beyond the box, from the depth where most of them lie. */
struct RoughObject
{
  std::vector<Eigen::Vector3d> points;  //!< Some hundred, from the lowest up, optical frame [m]
  std::vector<double> planeShares;      //!< Of each plane of the scene the share inside the box

  bool empty() const { return points.empty(); }
};

RoughObject roughObject(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const DetectedObject& detection,
    const LabelProperties& label,
    const PerceptionOptions& options);

/** How an object lies with respect to a horizontal plane. Shares are in [0, 1]. */
struct StandingEvidence
{
  double covered = 0;  //!< Share of the object's lower points that the plane reaches under
  double above = 0;    //!< Share of its points clearly above
  double below = 0;    //!< ... clearly below: what stands on a plane has none there
  double gap = 0;      //!< From the plane to its lowest points [m], >= 0
  double top = 0;      //!< From the plane to its highest points [m]
  double absent =
      0;  //!< Share of the gap, outside the box, where the object would show but does not
};

/** A level surface that something may stand on. */
struct SupportSurface
{
  Plane plane;
  PlaneExtent extent;
  std::optional<ImageBox> box = {};  //!< Of the thing whose top it is: it reaches no farther
};

/** \param object Not empty. \param box The detector's. */
StandingEvidence standingEvidence(
    const DepthCloud& cloud,
    const SupportSurface& surface,
    const RoughObject& object,
    const ImageBox& box,
    const LabelProperties& label,
    const PerceptionOptions& options);

/** The level top of the object in one box as far as other boxes leave it free: the cover of a book
 * that a cup stands on, too small to be a plane of the scene. Nothing when hardly any of it shows.
 * \param box Of the object. \param others Boxes that end on it. */
std::optional<ScenePlane> topOf(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const RoughObject& object,
    const ImageBox& box,
    const std::vector<ImageBox>& others,
    const PerceptionOptions& options);

/** Where the surroundings of a box are taken from. */
enum class Ring
{
  LowerHalf,  //!< Beside and under the lower half: what shows a level support
  All         //!< All around: what shows a wall
};

/** Down in the image at the middle of a box, unit; a camera may be mounted any way round. */
Eigen::Vector2d downInImage(
    const PinholeCamera& camera, const Eigen::Vector3d& up, const ImageBox& box);

/** What of the surroundings of a box lies on a plane. */
struct RingEvidence
{
  double share = 0;                      //!< Of the valid depths
  std::vector<Eigen::Vector3d> surface;  //!< Points on it, outside the box, that face as it does
};

/** A point in the surroundings of a box. */
struct RingPoint
{
  Eigen::Vector3d point;
  std::optional<Eigen::Vector3d> normal;  //!< Outside the box, on a horizontal plane
  double tolerance = 0;                   //!< For lying on a plane [m]
  double noise = 0;                       //!< Standard deviation of its depth [m]
  double nearest = 0;  //!< To the nearest horizontal plane that reaches there [m]
  bool inBox = false;  //!< In the lowest tenth of the box: the support shows there, too
  bool lower = false;  //!< Below the middle of the box
  bool beside = true;  //!< No farther from the object than such a thing is large
};

/** The surroundings of a box: a ring of an eighth of its size, some hundred points. */
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

/** Of two levels a hand's breadth or less apart a point shows the nearer one only. */
RingEvidence ringOn(const std::vector<RingPoint>& points, const Plane& plane, Ring ring);

/** Of points on a surface those that belong to the seen part of it: the segmentation loses the far
 * ends of surfaces. Where the camera looks down past the surface in between, it has ended. */
std::vector<Eigen::Vector3d> connectedTo(
    const DepthCloud& cloud,
    const SupportSurface& surface,
    std::vector<Eigen::Vector3d> points,
    const PerceptionOptions& options);

}  // namespace quadmap
