#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "DepthCloud.h"
#include "ScenePlanes.h"
#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** The part of a depth image that one detected object is made of. */
struct ObjectCloud
{
  struct Cell
  {
    int c, r;
  };
  std::vector<Cell> cells;              //!< In the depth cloud
  std::vector<Eigen::Vector3d> points;  //!< Of these cells, optical frame [m]
  std::optional<int> support;           //!< Plane it stands on, index in ScenePlanes
  double coverage = 0;                  //!< Share of the box's cells with valid depth
  double leak = 0;  //!< Share of the box's outline across which the surface goes on outside

  bool empty() const { return points.empty(); }
};

/** One detection of the frame, with what is known about it before its points are cut out. */
struct ObjectTask
{
  const DetectedObject* detection = nullptr;  //!< Never null
  LabelProperties label;
  std::optional<int> support;  //!< Plane it stands on, index in ScenePlanes
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
