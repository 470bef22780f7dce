#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/CellMask.h"
#include "quadmap/surfaces/DepthCloud.h"
#include "quadmap/surfaces/ScenePlanes.h"
#include "quadmap/surfaces/WallDistance.h"

namespace quadmap
{
/** The part of a depth image that one detected object is made of. */
struct ObjectCloud
{
  struct Cell
  {
    int c, r;
  };
  /** In the depth cloud: every step-th of every step-th row, and of those along the rim, which
   * `mask` has all, every step-th. */
  std::vector<Cell> cells;
  int step = 1;
  std::vector<Eigen::Vector3d> points;  //!< Of these cells, optical frame [m]
  CellMask mask;                        //!< All its cells
  std::optional<int> support;           //!< Plane it stands on, index in ScenePlanes
  std::optional<WallDistance> onWall;   //!< Of things that usually hang on walls, and do
  std::optional<Plane> top;             //!< Where its kind ends in a horizontal surface; normal up
  double coverage = 0;                  //!< Share of the box's cells with valid depth
  ImageBox box;                         //!< Of the detector [px]
  DepthCloud::CellRange inBox;          //!< The cells of this box; some lie around it
  double leak = 0;  //!< Share of the box's outline across which the surface goes on outside

  bool empty() const { return points.empty(); }
};

/** Do two boxes of one frame show the same thing, perhaps under two labels? One does not hide the
 * other then. AgreementOptions::duplicateIoU asks for more, as a box is dropped by it. */
inline bool showOneThing(const ImageBox& a, const ImageBox& b) { return imageBoxIoU(a, b) > 0.55; }

/** Coordinates of some points [m], enough of them for a quantile of the middle.
 * \param axis 0 to 2. */
std::vector<double> sampleOf(const std::vector<Eigen::Vector3d>& points, int axis);

/** One detection of the frame, with what is known about it before its points are cut out. */
struct ObjectTask
{
  const DetectedObject* detection = nullptr;  //!< Never null
  LabelProperties label;
  std::optional<int> support = {};  //!< Plane it stands on, index in ScenePlanes
  std::optional<int> wall = {};     //!< Plane it hangs on, index in ScenePlanes
};

/** Cuts the objects of a frame out of their boxes. Of each box the support, the walls around and
 * planes that reach far beyond it are removed; the rest falls into clusters, and the one that fills
 * the box best and ends there is the object, with fragments at its depth. What stands alone in its
 * own box is no part of the other boxes' objects (doc/mathematics.md).
 * \return One for each task; empty where there is no such cluster. */
std::vector<ObjectCloud> segmentObjects(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const std::vector<ObjectTask>& tasks,
    const PerceptionOptions& options);

}  // namespace quadmap
