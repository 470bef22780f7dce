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

  bool empty() const { return points.empty(); }
};

/** One detection of the frame, with what is known about it before its points are cut out. */
struct ObjectTask
{
  const DetectedObject* detection = nullptr;  //!< Never null
  LabelProperties label;
  std::optional<int> support;        //!< Plane it stands on, index in ScenePlanes
  std::optional<int> wall;           //!< Plane its back hangs at, index in ScenePlanes
  std::vector<std::size_t> carries;  //!< Detections of the frame that stand on this object
};

/** Cuts an object out of its box: planes that reach far beyond the box and the supporting plane
 * are removed, the rest falls into clusters, and the one that fills the box best is the object
 * (doc/mathematics.md). Empty when there is no such cluster.
 * \param tasks All detections of the frame. \param index Of the one to cut out. */
ObjectCloud segmentObject(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const std::vector<ObjectTask>& tasks,
    std::size_t index,
    const PerceptionOptions& options);

}  // namespace quadmap
