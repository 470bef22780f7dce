#pragma once

#include <Eigen/Dense>
#include <vector>

#include "quadmap/geometry/Plane.h"
#include "quadmap/surfaces/DepthCloud.h"
#include "quadmap/surfaces/PlaneExtent.h"

namespace quadmap
{
/** One flat surface of the frame, in the optical frame; normal towards the camera. */
struct ScenePlane
{
  Plane plane;
  double share = 0;  //!< Of the image's cells, in [0, 1]; 0: known from other frames, or a top
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> samples;  //!< Some of its points
  std::vector<Eigen::Vector3d> rim;      //!< Its outermost points
  PlaneExtent extent;                    //!< Of horizontal planes
  bool isFurniture = false;              //!< Something shows under it, or it is in a detector's box
  bool isFloor = false;  //!< Known from other frames as a floor that ends, as a platform does
};

/** The planes of a frame and which cell belongs to which. */
class PlaneSegmentation
{
 public:
  std::vector<ScenePlane> planes;  //!< The largest first; then those from elsewhere, then tops

  /** Index into `planes` of the plane that a cell of the cloud, or one near it, belongs to and
   * that its point is within the tolerance [m] of; -1 for none. */
  int planeAt(const DepthCloud& cloud, int c, int r, double tolerance) const;

  /** For each plane the share of its cells that lie in a range of the cloud's cells, in [0, 1]. */
  std::vector<double> sharesWithin(const DepthCloud::CellRange& range) const;

 private:
  friend PlaneSegmentation segmentPlanes(const DepthCloud&, const SurfaceOptions&);
  void findRims(const DepthCloud& cloud, const SurfaceOptions& options);
  void findLabelsAround();

  int columns_ = 0, rows_ = 0;
  std::vector<int> labels_;
  std::vector<int> around_;  // the only label at or near each cell; kNone, or kSeveral
};

/** All planes of the frame, at a quarter of the cloud's resolution. */
PlaneSegmentation segmentPlanes(const DepthCloud& cloud, const SurfaceOptions& options);

}  // namespace quadmap
