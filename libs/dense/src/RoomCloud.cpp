#include "quadmap/dense/RoomCloud.h"

#include "FramePoints.h"
#include "GridCloud.h"

namespace quadmap
{
DenseCloud fuseRoom(
    const std::string& result,
    const DenseOptions& options,
    const std::function<void(double)>& progress)
{
  PointGrid grid(options.roomCell);
  const auto addImage = [&](const KeyframeScan& image)
  { forEachPoint(image, options, [&](const MeasuredPoint& point) { grid.add(point); }); };
  forEachDepthImage(result, ResultKeyframes::Boxes::Ignore, options, addImage, progress);
  return cloudOf(grid, trustedCells(grid, options), options);
}

}  // namespace quadmap
