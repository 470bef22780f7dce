#pragma once

#include <vector>

#include "edges/EdgeMeasurements.h"
#include "edges/EdgeStrips.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** Where an object ends towards one edge of its box: of each row (left and right edges) or column
 * its last cell, when it lies within `edgeTolerance` of the outermost one. */
class ObjectEnd
{
 public:
  /** \param cloud Must outlive it. */
  ObjectEnd(
      const DepthCloud& cloud,
      const EdgeContext& context,
      BoxEdge edge,
      const PerceptionOptions& options);

  /** Of the cells where the edge meets the border of the image: the object may go on out there. */
  double shareAtBorder() const;
  /** From the object's outermost cell outwards to the edge of a box [px]; 0 without cells. */
  double shortOf(const ImageBox& box) const;

 private:
  const DepthCloud& cloud_;
  const BoxEdge edge_;
  const bool upright_;
  const int outwards_;      // 1 or -1
  std::vector<int> lines_;  // rows or columns in which it ends there
  int outermost_;           // column or row, times `outwards_`
};

}  // namespace quadmap
