#pragma once

#include <vector>

#include "edges/EdgeStrips.h"
#include "edges/Occluders.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** Where an object ends towards one edge of its box: of each row (left and right edges) or column
 * its last cell, when it lies within `edgeTolerance` of the outermost one. What cuts an object
 * meets it there; what stands before another part of the edge does not. */
class ObjectEnd
{
 public:
  /** All references must outlive it. */
  ObjectEnd(
      const DepthCloud& cloud,
      const EdgeContext& context,
      BoxEdge edge,
      const Occluders& occluders,
      const PerceptionOptions& options);

  double shareBehind() const;  //!< Of the cells that something nearer touches from beyond the edge
  /** Of the cells where the edge meets the border of the image: the object may go on out there. */
  double shareAtBorder() const;
  /** From the object's outermost cell outwards to the edge of a box [px]; 0 without cells. */
  double shortOf(const ImageBox& box) const;

 private:
  struct End
  {
    int line;      // row or column
    int position;  // column or row, times `outwards_`
  };

  bool isNearerBeyond(const End& end) const;
  ObjectCloud::Cell cell(int line, int position) const
  {
    const int across = position * outwards_;
    return upright_ ? ObjectCloud::Cell{across, line} : ObjectCloud::Cell{line, across};
  }
  int cellsOf(double pixels) const;  // [px of an image 640 wide]
  template <typename IsIt>
  double share(const IsIt& isIt) const;

  const DepthCloud& cloud_;
  const ObjectCloud& object_;
  const Occluders& occluders_;
  const BoxEdge edge_;
  const bool upright_;
  const int outwards_;  // 1 or -1
  const int strip_;     // that is looked at [cells]
  std::vector<End> ends_;
  int outermost_;  // column or row, times `outwards_`
};

}  // namespace quadmap
