#pragma once

#include <vector>

#include "edges/EdgeMeasurements.h"

namespace quadmap
{
/** Tells which cells of a frame show something in front of one object. */
class Occluders
{
 public:
  /** All references must outlive it. \param box Of the object [px]. */
  Occluders(
      const DepthCloud& cloud,
      const ImageBox& box,
      const EdgeContext& context,
      const PerceptionOptions& options);

  /** Is something at this cell nearer than `limit` [m], which is no part of the object? A cell
   * without depth is as near as the screen that it lies on; elsewhere it lies in the shadow of a
   * depth edge and tells nothing. */
  bool isNearer(int c, int r, double limit) const
  {
    return cloud_.valid(c, r) ? !isOwnOutside(c, r) && isInFront(c, r, limit)
                              : isOnScreen(c, r, limit);
  }

 private:
  struct CellsAtDepth
  {
    DepthCloud::CellRange cells;
    double depth;  // [m]
  };

  /** Does a cell belong to the object, outside its box? */
  bool isOwnOutside(int c, int r) const
  {
    return context_.object.mask.contains(c, r) && !inside_.contains(c, r);
  }
  bool isInFront(int c, int r, double limit) const
  {
    return cloud_.depth(c, r) < limit && !hidesOnlyBelow(c, r);
  }
  bool isOnScreen(int c, int r, double limit) const;
  bool hidesOnlyBelow(int c, int r) const;

  const DepthCloud& cloud_;
  const EdgeContext& context_;
  const PerceptionOptions& options_;
  const DepthCloud::CellRange inside_;  // cells of the box
  std::vector<CellsAtDepth> screens_;
  double lowest_;  // height of the lowest seen of the object above the camera, at most 0 [m]
};

}  // namespace quadmap
