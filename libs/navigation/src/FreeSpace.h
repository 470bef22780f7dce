#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <Eigen/Dense>
#include <optional>
#include <vector>

namespace quadmap
{
/** Where a round robot can go in a grid, and how far it is from where it starts. */
class FreeSpace
{
 public:
  /** \param start Where the robot is [m]; it may drive off from next to an obstacle.
   *  \param radius Of the robot [m]. \param minFree Probability of free cells. */
  FreeSpace(
      const mrpt::maps::COccupancyGridMap2D& grid,
      const Eigen::Vector2d& start,
      double radius,
      double minFree);

  /** Length of the shortest way to a place, or nothing when there is none, or the place is not free
   * [m]. */
  std::optional<double> wayTo(const Eigen::Vector2d& place) const;

 private:
  using Cell = Eigen::Vector2i;

  Cell cellAt(const Eigen::Vector2d& place) const
  {
    // MRPT's x2idx() rounds toward zero, so that what is left of the grid would be in its first
    // cell.
    const auto resolution = static_cast<double>(grid_.getResolution());
    const Eigen::Vector2d corner(grid_.getXMin(), grid_.getYMin());
    return ((place - corner) / resolution).array().floor().cast<int>();
  }
  bool isInside(const Cell& cell) const
  {
    return cell.x() >= 0 && cell.y() >= 0 && cell.x() < width_ && cell.y() < height_;
  }
  std::size_t indexOf(const Cell& cell) const
  {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(cell.x());
  }
  void blockAround(double radius, double minFree);
  void blockBorder(double radius);
  void leave(const Cell& start, double radius);
  void measureWays(const Cell& start);

  const mrpt::maps::COccupancyGridMap2D& grid_;
  int width_, height_;
  std::vector<char> isBlocked_;  // the robot's centre must not stay there
  std::vector<char> isClosed_;   // nor may its way lead through it
  std::vector<double> ways_;     // [cells], infinite where there is none
};

}  // namespace quadmap
