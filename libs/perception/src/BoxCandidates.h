#pragma once

#include <Eigen/Dense>
#include <vector>

#include "ObjectCloud.h"

namespace quadmap
{
/** The cells of a detector's box that may belong to its object. */
struct BoxCandidates
{
  std::vector<ObjectCloud::Cell> cells;
  std::vector<Eigen::Vector3d> points;  //!< Of these cells, optical frame [m]
  DepthCloud::CellRange range;          //!< Where was looked: the enlarged box
};

/** Drops the candidates for which `keep(index)` is false. */
template <typename Keep>
void keepOnly(BoxCandidates& candidates, const Keep& keep)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < candidates.cells.size(); ++i)
  {
    if (!keep(i)) continue;
    candidates.cells[kept] = candidates.cells[i];
    candidates.points[kept++] = candidates.points[i];
  }
  candidates.cells.resize(kept);
  candidates.points.resize(kept);
}

/** Cells of the enlarged box (or the mask) with depth, without the supporting plane, without planes
 * that reach far beyond the box and without the wall behind it. */
BoxCandidates candidatesIn(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const PerceptionOptions& options);

/** A point nearer than this to its supporting plane belongs to the plane [m]; thin objects (a book)
 * allow less than tall ones. \param z Depth [m]. */
double supportTolerance(double z, const LabelProperties& label, const PerceptionOptions& options);

}  // namespace quadmap
