#include "FreeFloor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "Floor.h"

namespace quadmap::simulator
{
namespace
{
constexpr double kCell = 0.1;     // [m]
constexpr double kComfort = 0.3;  // nearer than so much beyond the margin, a step counts more [m]
constexpr double kFlat = 0.03;    // lower things are no obstacle [m]

/** Distance of a point to the walls and to the boxes [m]. */
double clearanceAt(
    const Eigen::Vector2d& p, const Eigen::Vector2d& half, const std::vector<UprightBox>& boxes)
{
  double clearance = (half - p.cwiseAbs()).minCoeff();
  for (const auto& box : boxes) clearance = std::min(clearance, box.distanceTo(p));
  return clearance;
}

}  // namespace

FreeFloor::FreeFloor(const Scene& scene, double margin, double headroom)
{
  std::vector<UprightBox> boxes;
  for (const auto& object : scene.objects)
    for (const auto& box : partBoxes(object))
      if (box.low < headroom && box.high > kFlat) boxes.push_back(box);
  const Eigen::Vector2d half = scene.room.size.head<2>() / 2;
  low_ = -half;
  columns_ = static_cast<int>(scene.room.size.x() / kCell);
  rows_ = static_cast<int>(scene.room.size.y() / kCell);
  std::vector<double> clearance;
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i)
      clearance.push_back(
          clearanceAt(low_ + kCell * Eigen::Vector2d(i + 0.5, j + 0.5), half, boxes));
  keepLargestPart(clearance, margin);
  for (auto& c : clearance_) c -= margin;
}

void FreeFloor::keepLargestPart(const std::vector<double>& clearance, double margin)
{
  const int cells = columns_ * rows_;
  std::vector<int> best;
  std::vector<bool> seen(static_cast<std::size_t>(cells), false);
  const auto isNew = [&](int cell)
  {
    return !seen[static_cast<std::size_t>(cell)] &&
           clearance[static_cast<std::size_t>(cell)] > margin;
  };
  for (int start = 0; start < cells; ++start)
  {
    if (!isNew(start)) continue;
    std::vector<int> part{start};
    seen[static_cast<std::size_t>(start)] = true;
    for (std::size_t k = 0; k < part.size(); ++k)
      for (const auto& [di, dj] : {
               std::pair{ 1,  0},
               {-1,  0},
               { 0,  1},
               { 0, -1}
      })
      {
        const int i = part[k] % columns_ + di, j = part[k] / columns_ + dj;
        if (i < 0 || j < 0 || i >= columns_ || j >= rows_ || !isNew(j * columns_ + i)) continue;
        seen[static_cast<std::size_t>(j * columns_ + i)] = true;
        part.push_back(j * columns_ + i);
      }
    if (part.size() > best.size()) best = part;
  }
  placeOfCell_.assign(static_cast<std::size_t>(cells), -1);
  for (const int cell : best)
  {
    placeOfCell_[static_cast<std::size_t>(cell)] = static_cast<int>(places_.size());
    cellOfPlace_.push_back(cell);
    places_.push_back(low_ + kCell * Eigen::Vector2d(cell % columns_ + 0.5, cell / columns_ + 0.5));
    clearance_.push_back(clearance[static_cast<std::size_t>(cell)]);
  }
}

double FreeFloor::area() const { return kCell * kCell * static_cast<double>(places_.size()); }

int FreeFloor::cellOf(const Eigen::Vector2d& p) const
{
  const Eigen::Vector2d at = (p - low_) / kCell;
  const int i = static_cast<int>(std::floor(at.x())), j = static_cast<int>(std::floor(at.y()));
  return i < 0 || j < 0 || i >= columns_ || j >= rows_ ? -1 : j * columns_ + i;
}

bool FreeFloor::isFree(const Eigen::Vector2d& p) const
{
  const int cell = cellOf(p);
  return cell >= 0 && placeOfCell_[static_cast<std::size_t>(cell)] >= 0;
}

std::vector<std::size_t> FreeFloor::way(std::size_t from, std::size_t to) const
{
  std::vector<double> cost(places_.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> before(places_.size(), from);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[from] = 0;
  open.push({0, from});
  while (!open.empty())
  {
    const auto [reached, here] = open.top();
    open.pop();
    if (here == to) break;
    if (reached > cost[here]) continue;
    const int cell = cellOfPlace_[here];
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj)
      {
        const int i = cell % columns_ + di, j = cell / columns_ + dj;
        if (i < 0 || j < 0 || i >= columns_ || j >= rows_) continue;
        const int next = placeOfCell_[static_cast<std::size_t>(j * columns_ + i)];
        if (next < 0) continue;
        const auto n = static_cast<std::size_t>(next);
        const double narrow = 1 + 2 * std::max(0.0, kComfort - clearance_[n]) / kComfort;
        const double total = reached + narrow * std::hypot(di, dj);
        if (total >= cost[n]) continue;
        cost[n] = total;
        before[n] = here;
        open.push({total, n});
      }
  }
  std::vector<std::size_t> way{to};
  while (way.back() != from) way.push_back(before[way.back()]);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace quadmap::simulator
