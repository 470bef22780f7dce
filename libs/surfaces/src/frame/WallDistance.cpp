#include "quadmap/surfaces/WallDistance.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
/** A range of cells without a share of its width and height on each side. */
DepthCloud::CellRange middleOf(DepthCloud::CellRange range, double share)
{
  const int columns = static_cast<int>(share * (range.c1 - range.c0));
  const int rows = static_cast<int>(share * (range.r1 - range.r0));
  return {range.c0 + columns, range.r0 + rows, range.c1 - columns, range.r1 - rows};
}

}  // namespace

std::optional<WallDistance> distanceFromWall(
    const DepthCloud& cloud, const DepthCloud::CellRange& box, const Plane& wall)
{
  constexpr double kRim = 0.15;  // of the box
  constexpr std::size_t kFewest = 30;
  const auto middle = middleOf(box, kRim);
  std::vector<double> near;
  std::size_t others = 0;
  for (int r = middle.r0; r < middle.r1; ++r)
    for (int c = middle.c0; c < middle.c1; ++c)
    {
      if (!cloud.valid(c, r)) continue;
      const double distance = wall.signedDistance(cloud.point(c, r).cast<double>());
      if (mayHangOnWall(distance))
        near.push_back(distance);
      else
        ++others;
    }
  if (near.size() < std::max(kFewest, others)) return {};
  return WallDistance{wall, std::max(0.0, median(std::move(near)))};
}

}  // namespace quadmap
