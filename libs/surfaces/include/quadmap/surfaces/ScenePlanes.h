#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "quadmap/surfaces/PlaneSegmentation.h"
#include "quadmap/surfaces/SurfacePatch.h"

namespace quadmap
{
/** The planes with respect to the up direction. */
struct ScenePlanes
{
  PlaneSegmentation all;
  std::vector<int> horizontal;  //!< Indices of those that face up, from the lowest to the highest
  std::vector<int> vertical;
  std::optional<int> floor;       //!< The lowest horizontal one, when nothing much lies under it
  bool floorSeen = false;         //!< False: the floor is the one known from other frames, if any
  bool contradictsFloor = false;  //!< Something shows below the known floor, which does not show
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();  //!< Optical frame, unit
  std::vector<Eigen::Vector3f> seenThrough;  //!< Samples of known surfaces that are not there [m]

  const ScenePlane& plane(int index) const { return all.planes[static_cast<std::size_t>(index)]; }

  /** Is it the floor, or another one that is no thing's top, as a platform? */
  bool isFloor(int index) const
  {
    return floor == index || (plane(index).isFloor && !plane(index).isFurniture);
  }
};

/** The up direction when nobody knows it: the normal of the plane that most of the scene lies
 * above. Nothing when there is no plane. */
std::optional<Eigen::Vector3d> upFromPlanes(
    const DepthCloud& cloud, const std::vector<ScenePlane>& planes);

/** Sorts planes by orientation, adds what other frames know, and finds the floor: the lowest
 * horizontal plane with nothing under it, unless other frames have seen a lower one.
 * \param known Surfaces of the room, optical frame; what this frame looks through is left out. */
ScenePlanes classifyPlanes(
    const DepthCloud& cloud,
    PlaneSegmentation segmentation,
    const Eigen::Vector3d& up,
    const std::vector<SurfacePatch>& known,
    const SurfaceOptions& options);

/** What the frame says about the surfaces of the room, optical frame. */
FrameSurfaces surfacesOf(const DepthCloud& cloud, const ScenePlanes& planes);

}  // namespace quadmap
