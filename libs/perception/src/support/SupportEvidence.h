#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/DepthCloud.h"
#include "quadmap/surfaces/ScenePlanes.h"

namespace quadmap
{
/** What a box shows of its object before the object is cut out. These are points at the depth where
 * most of the box lies, without those of surfaces that reach far beyond the box. */
struct RoughObject
{
  /** Share of a plane inside the box that makes it the object's own, as the top of a bed is. */
  static constexpr double kOwnShare = 0.5;

  std::vector<Eigen::Vector3d> points;  //!< Some hundred, from the lowest up, optical frame [m]
  std::vector<double> planeShares;      //!< Of each plane of the scene the share inside the box

  bool empty() const { return points.empty(); }
  /** \param plane Index in the scene. Of one that was added later nothing is known: it is not. */
  bool owns(int plane) const
  {
    const auto index = static_cast<std::size_t>(plane);
    return index < planeShares.size() && planeShares[index] >= kOwnShare;
  }
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
  double covered = 0;  //!< Share of the object's points that the plane reaches under
  double below = 0;    //!< Share of its points below: what stands on a plane has none there
  double gap = 0;      //!< From the plane to its lowest points [m], >= 0
  double top = 0;      //!< From the plane to its highest point [m]
  /** Share of the gap, outside the box, where the object would show but does not. Of a high gap it
   * is the share of the lines down on which the object ends somewhere. */
  double absent = 0;

  /** Is the gap higher than the parts of what stands that depth and boxes miss, as thin legs? */
  bool isHigh() const
  {
    constexpr double kHighestUnseen = 0.5;  // [m]
    return gap > kHighestUnseen;
  }

  /** Does the object end in the air, far above the plane? */
  bool endsAbove() const
  {
    constexpr double kMost = 0.5;
    return isHigh() && absent > kMost;
  }
};

/** A horizontal surface that something may stand on. */
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
    const PerceptionOptions& options);

/** The horizontal top of the object in one box. An example is the cover of a book that a cup stands
 * on: it is too small to be a plane of the scene. Nothing is returned when hardly any of it shows.
 * \param box Of the object. */
std::optional<ScenePlane> topOf(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const RoughObject& object,
    const ImageBox& box,
    const PerceptionOptions& options);

}  // namespace quadmap
