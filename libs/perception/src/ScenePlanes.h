#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "DepthCloud.h"
#include "quadmap/geometry/Plane.h"

namespace quadmap
{
/** One flat surface of the frame, in the optical frame; normal towards the camera. */
struct ScenePlane
{
  Plane plane;
  double share = 0;  //!< Share of the image's cells, in [0, 1]
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
};

/** The planes of a frame and which cell belongs to which. */
class PlaneSegmentation
{
 public:
  std::vector<ScenePlane> planes;  //!< The largest first; a floor known from elsewhere last

  /** Index into `planes` of the plane that a cell of the cloud, or one near it, belongs to and
   * that its point is within the tolerance [m] of; -1 for none. */
  int planeAt(const DepthCloud& cloud, int c, int r, double tolerance) const;

  /** For each plane the share of its cells that lie in a range of the cloud's cells, in [0, 1]. */
  std::vector<double> sharesWithin(const DepthCloud::CellRange& range) const;

 private:
  friend PlaneSegmentation segmentPlanes(const DepthCloud&, const PerceptionOptions&);
  int columns_ = 0, rows_ = 0;
  std::vector<int> labels_;
};

/** All planes of the frame (PCL's organised segmentation at quarter resolution). */
PlaneSegmentation segmentPlanes(const DepthCloud& cloud, const PerceptionOptions& options);

/** The planes with respect to the up direction. */
struct ScenePlanes
{
  PlaneSegmentation all;
  std::vector<int> horizontal;  //!< Indices of those that face up, from the lowest to the highest
  std::vector<int> vertical;
  std::optional<int> floor;  //!< The lowest horizontal one, when nothing much lies under it
  bool floorSeen = false;    //!< False: the floor is the one known from other frames
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();  //!< Optical frame, unit

  const ScenePlane& plane(int index) const { return all.planes[static_cast<std::size_t>(index)]; }
};

/** The up direction when nobody knows it: the normal of the plane that most of the scene lies
 * above. Nothing when there is no plane. */
std::optional<Eigen::Vector3d> upFromPlanes(
    const DepthCloud& cloud, const std::vector<ScenePlane>& planes);

/** Sorts planes by orientation and finds the floor: the lowest horizontal plane with nothing under
 * it, unless other frames have seen a lower one (`knownFloor`, optical frame). */
ScenePlanes classifyPlanes(
    const DepthCloud& cloud,
    PlaneSegmentation segmentation,
    const Eigen::Vector3d& up,
    const std::optional<Plane>& knownFloor,
    const PerceptionOptions& options);

}  // namespace quadmap
