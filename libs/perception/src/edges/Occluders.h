#pragma once

#include <optional>
#include <vector>

#include "edges/EdgeMeasurements.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

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

  /** Share of the cells of a part of the object's box that show something nearer than `limit` [m]
   * and are no part of the object. */
  double shareNearer(const ImageBox& part, double limit) const;

  /** Of a point at a depth that may lie on a supporting surface [m]. */
  double onSupport(double depth) const
  {
    return unevenSupportTolerance(2.0 * options_.depthSigma(depth));
  }
  bool isOnSupport(int c, int r) const;  //!< \param c, r A cell with depth

  /** What may be taken for the object's own depth, or for that of what touches it [m]. The depth of
   * an object without a cloud of its own is that of its surroundings. */
  double depthMargin(double depth) const
  {
    constexpr double kShareWithoutCloud = 0.25;
    return depthTolerance(depth, options_) +
           (context_.object.empty() ? kShareWithoutCloud * depth : 0.0);
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
    return cloud_.depth(c, r) < limit && !isOnSupport(c, r) && !hidesOnlyBelow(c, r);
  }
  bool isOnScreen(int c, int r, double limit) const;
  bool hidesOnlyBelow(int c, int r) const;
  double lowestHeight() const;

  const DepthCloud& cloud_;
  const EdgeContext& context_;
  const PerceptionOptions& options_;
  const DepthCloud::CellRange inside_;  // cells of the box
  std::vector<CellsAtDepth> screens_;
  std::optional<double> lowest_;  // height of the object's lower end [m]
};

}  // namespace quadmap
