#include "FreeSpace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace quadmap
{
namespace
{
constexpr double kNoWay = std::numeric_limits<double>::infinity();

/** Calls use(offset) for all cells whose centres are within a radius [cells]. */
template <typename F>
void forEachWithin(double radius, const F& use)
{
  const int reach = static_cast<int>(std::floor(radius));
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (std::hypot(dx, dy) <= radius) use(Eigen::Vector2i(dx, dy));
}

}  // namespace

FreeSpace::FreeSpace(
    const mrpt::maps::COccupancyGridMap2D& grid,
    const Eigen::Vector2d& start,
    double radius,
    double minFree) :
    grid_(grid),
    width_(static_cast<int>(grid.getSizeX())),
    height_(static_cast<int>(grid.getSizeY())),
    isBlocked_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0),
    ways_(isBlocked_.size(), kNoWay)
{
  const double cells = radius / static_cast<double>(grid.getResolution());
  blockAround(cells + 0.5, minFree);  // to the border of a cell
  blockBorder(cells);
  isClosed_ = isBlocked_;
  leave(cellAt(start), cells);
  measureWays(cellAt(start));
}

void FreeSpace::blockAround(double radius, double minFree)
{
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (static_cast<double>(grid_.getCell(x, y)) < minFree)
        forEachWithin(
            radius,
            [&](const Cell& offset)
            {
              const Cell near = Cell(x, y) + offset;
              if (isInside(near)) isBlocked_[indexOf(near)] = 1;
            });
}

/** Nothing is known of what is outside the grid. \param radius [cells] */
void FreeSpace::blockBorder(double radius)
{
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (std::min({x, y, width_ - 1 - x, height_ - 1 - y}) + 0.5 < radius)
        isBlocked_[indexOf({x, y})] = 1;
}

/** The robot is where it is, so that it can leave from there. */
void FreeSpace::leave(const Cell& start, double radius)
{
  forEachWithin(
      radius,
      [&](const Cell& offset)
      {
        const Cell near = start + offset;
        if (isInside(near)) isClosed_[indexOf(near)] = 0;
      });
}

/** Dijkstra's algorithm over the eight neighbours of each cell. */
void FreeSpace::measureWays(const Cell& start)
{
  if (!isInside(start)) return;
  using Entry = std::pair<double, std::pair<int, int>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> next;
  ways_[indexOf(start)] = 0;
  next.push({
      0.0, {start.x(), start.y()}
  });
  while (!next.empty())
  {
    const auto [way, at] = next.top();
    next.pop();
    const Cell cell(at.first, at.second);
    if (way > ways_[indexOf(cell)]) continue;
    forEachWithin(
        1.5,  // the diagonal neighbours, too
        [&, way = way](const Cell& offset)
        {
          const Cell near = cell + offset;
          if (!isInside(near) || isClosed_[indexOf(near)]) return;
          const double longer = way + offset.cast<double>().norm();
          if (longer >= ways_[indexOf(near)]) return;
          ways_[indexOf(near)] = longer;
          next.push({
              longer, {near.x(), near.y()}
          });
        });
  }
}

std::optional<double> FreeSpace::wayTo(const Eigen::Vector2d& place) const
{
  const Cell cell = cellAt(place);
  if (!isInside(cell) || isBlocked_[indexOf(cell)] || ways_[indexOf(cell)] == kNoWay)
    return std::nullopt;
  return ways_[indexOf(cell)] * static_cast<double>(grid_.getResolution());
}

}  // namespace quadmap
