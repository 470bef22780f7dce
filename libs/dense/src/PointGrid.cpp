#include "PointGrid.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
/** The slot of a key, or the free one where it belongs: the next free one after that of its hash.
 */
std::size_t PointGrid::slotOf(const Key& key) const
{
  std::uint64_t h = 0;
  for (const std::int32_t part : key)
    h = (h ^ static_cast<std::uint32_t>(part)) * 0x9E3779B97F4A7C15;
  std::size_t slot = (h >> 32) & (slots_.size() - 1);
  while (slots_[slot] != 0 && cells_[slots_[slot] - 1].key != key)
    slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

void PointGrid::enlarge()
{
  slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), 0);
  for (std::size_t i = 0; i < cells_.size(); ++i)
    slots_[slotOf(cells_[i].key)] = static_cast<std::uint32_t>(i + 1);
}

void PointGrid::add(const MeasuredPoint& point)
{
  constexpr float kFarthest = 1e9F;  // cells in one direction from the origin
  const Eigen::Vector3f corner = (point.position / cellSize_).array().floor();
  if (!(corner.cwiseAbs().maxCoeff() < kFarthest)) return;  // also what is not a number
  if (2 * cells_.size() >= slots_.size()) enlarge();
  const Key key{
      static_cast<std::int32_t>(corner.x()), static_cast<std::int32_t>(corner.y()),
      static_cast<std::int32_t>(corner.z())};
  std::uint32_t& slot = slots_[slotOf(key)];
  if (slot == 0)
  {
    cells_.push_back({key});
    slot = static_cast<std::uint32_t>(cells_.size());
  }
  Cell& cell = cells_[slot - 1];
  cell.offsetSum += point.weight * (point.position - corner * cellSize_);
  cell.rgbSum += point.weight * point.rgb;
  cell.toCameraSum += point.weight * point.toCamera;
  cell.weight += point.weight;
  ++cell.hits;
}

float PointGrid::heaviestAround(const Key& key) const
{
  float heaviest = 0;
  for (int i = 0; i < 27; ++i)
  {
    const Key neighbour{key[0] + i % 3 - 1, key[1] + i / 3 % 3 - 1, key[2] + i / 9 - 1};
    const std::uint32_t slot = slots_[slotOf(neighbour)];
    if (slot != 0) heaviest = std::max(heaviest, cells_[slot - 1].weight);
  }
  return heaviest;
}

std::vector<std::size_t> PointGrid::strongCells(std::uint32_t hits, float share) const
{
  std::vector<std::size_t> strong;
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (cells_[i].hits >= hits && cells_[i].weight >= share * heaviestAround(cells_[i].key))
      strong.push_back(i);
  return strong;
}

Eigen::Vector3f PointGrid::position(std::size_t cell) const
{
  const Cell& c = cells_[cell];
  const Eigen::Vector3f corner(float(c.key[0]), float(c.key[1]), float(c.key[2]));
  return corner * cellSize_ + c.offsetSum / c.weight;
}

std::array<std::uint8_t, 3> PointGrid::rgb(std::size_t cell) const
{
  const Eigen::Vector3f mean = cells_[cell].rgbSum / cells_[cell].weight;
  std::array<std::uint8_t, 3> rounded{};
  for (int i = 0; i < 3; ++i)
    rounded[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::lround(std::clamp(mean[i], 0.0F, 255.0F)));
  return rounded;
}

}  // namespace quadmap
