#include "LookedAtRegion.h"

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
constexpr double kNearby = 0.5;  // [m]
constexpr double kCell = 0.1;    // width of a cell [m]
constexpr int kReach = static_cast<int>(kNearby / kCell + 0.5);

/** All cells whose middle is within kNearby of the middle of cell 0. */
template <int D>
std::vector<std::array<int, D>> ball()
{
  std::vector<std::array<int, D>> cells;
  std::array<int, D> cell;
  cell.fill(-kReach);
  while (true)
  {
    int squared = 0;
    for (const int c : cell) squared += c * c;
    if (squared <= kReach * kReach) cells.push_back(cell);
    std::size_t axis = 0;
    while (axis < cell.size() && ++cell[axis] > kReach) cell[axis++] = -kReach;
    if (axis == cell.size()) return cells;
  }
}

}  // namespace

template <int D>
std::size_t LookedAtRegion<D>::Hash::operator()(const Cell& cell) const
{
  std::size_t hash = 0;
  for (const int c : cell) hash = hash * 1000003 + static_cast<std::size_t>(c + 5000);
  return hash;
}

template <int D>
typename LookedAtRegion<D>::Cell LookedAtRegion<D>::cellOf(const PointVector<D>& position)
{
  Cell cell;
  for (std::size_t i = 0; i < cell.size(); ++i)
    cell[i] = static_cast<int>(std::floor(position[static_cast<Eigen::Index>(i)] / kCell));
  return cell;
}

template <int D>
LookedAtRegion<D>::LookedAtRegion(const std::vector<PointVector<D>>& measured)
{
  if (measured.empty()) return;
  std::unordered_map<Cell, std::size_t, Hash> inCell;
  for (const auto& position : measured) ++inCell[cellOf(position)];
  const auto offsets = ball<D>();
  for (const auto& [cell, n] : inCell)
    for (const Cell& offset : offsets)
    {
      Cell other = cell;
      for (std::size_t i = 0; i < other.size(); ++i) other[i] += offset[i];
      near_[other] += n;
    }
  std::vector<std::size_t> counts;
  for (const auto& position : measured) counts.push_back(near(position));
  usual_ = medianElement(counts);
}

template <int D>
std::size_t LookedAtRegion<D>::near(const PointVector<D>& position) const
{
  const auto known = near_.find(cellOf(position));
  return known == near_.end() ? 0 : known->second;
}

template <int D>
bool LookedAtRegion<D>::contains(const PointVector<D>& position) const
{
  constexpr std::size_t kFew = 10;  // fewer measurements nearby tell nothing
  const std::size_t nearby = near(position);
  return nearby >= kFew && 2 * nearby >= usual_;
}

template class LookedAtRegion<2>;
template class LookedAtRegion<3>;

}  // namespace quadmap
