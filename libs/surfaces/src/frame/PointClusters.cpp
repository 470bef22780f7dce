#include "quadmap/surfaces/PointClusters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "quadmap/surfaces/DisjointSets.h"

namespace quadmap
{
namespace
{
/** Depth counted in cells that grow with the noise: the integral of dz / max(gap, 2 sigma(z)). */
class DepthScale
{
 public:
  DepthScale(double gap, const SurfaceOptions& options) : gap_(gap)
  {
    constexpr double kSigmas = 2.0;
    const double floor = kSigmas * options.depthNoise.floor;
    const double growth = kSigmas * options.depthNoise.growth;
    if (floor > gap_) gap_ = floor;
    if (!(growth > 0)) return;
    from_ = kNearest + std::sqrt((gap_ - floor) / growth);
    width_ = 1.0 / std::sqrt(floor * growth);
    slope_ = std::sqrt(growth / floor);
    offset_ = from_ / gap_ - width_ * std::atan(slope_ * (from_ - kNearest));
  }

  double operator()(double z) const
  {
    return z < from_ ? z / gap_ : offset_ + width_ * std::atan(slope_ * (z - kNearest));
  }

 private:
  static constexpr double kNearest = DepthNoise::kGrowsFrom;
  double gap_;
  double from_ = 1e9;  // depth from which the noise decides [m]
  double width_ = 0, slope_ = 0, offset_ = 0;
};

/** A cell of the grid: its three indices, 21 bits each. */
using Key = std::int64_t;
constexpr Key kAcross = Key(1) << 42, kDown = Key(1) << 21, kAway = 1;  // to the next cell

Key keyAt(double x, double y, double z)
{
  constexpr double kOffset = 1 << 20;  // nothing is negative: to cut off is to round down
  return static_cast<Key>(x + kOffset) * kAcross + static_cast<Key>(y + kOffset) * kDown +
         static_cast<Key>(z + kOffset);
}

/** The occupied cells of the grid, each with a number, in an open hash table: most of the time goes
 * into looking up neighbours. */
class Grid
{
 public:
  int numberOf(Key key)
  {
    constexpr std::size_t kSpace = 8;  // slots for a cell: most looks find a free one at once
    if (slots_.size() <= kSpace * keys_.size()) grow();
    Slot& slot = slots_[slotOf(key)];
    if (slot.number < 0)
    {
      slot = {key, static_cast<int>(keys_.size())};
      keys_.push_back(key);
    }
    return slot.number;
  }

  /** Of each cell the number of the component that it hangs together with. */
  DisjointSets::Numbers components() const
  {
    DisjointSets out(keys_.size());
    for (std::size_t i = 0; i < keys_.size(); ++i)
      for (int n = 0; n < 13; ++n)  // of the 26 around it; the others look from their side
      {
        const Key step = (n % 3 - 1) * kAway + (n / 3 % 3 - 1) * kDown + (n / 9 - 1) * kAcross;
        const int other = slots_[slotOf(keys_[i] + step)].number;
        if (other >= 0) out.join(static_cast<int>(i), other);
      }
    return out.numbers();
  }

 private:
  struct Slot
  {
    Key key = 0;
    int number = -1;  // free
  };

  /** Objects are many points but few cells: a small table stays in the processor's cache. */
  void grow()
  {
    ++bits_;
    slots_.assign(std::size_t(1) << bits_, Slot());
    for (std::size_t i = 0; i < keys_.size(); ++i)
      slots_[slotOf(keys_[i])] = {keys_[i], static_cast<int>(i)};
  }

  /** Where a key is, or the free slot where it belongs. */
  std::size_t slotOf(Key key) const
  {
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15u;  // 2^64 over the golden ratio
    std::size_t slot = (static_cast<std::uint64_t>(key) * kGolden) >> (64 - bits_);
    while (slots_[slot].number >= 0 && slots_[slot].key != key)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  unsigned bits_ = 10;  // of the number of slots
  std::vector<Slot> slots_ = std::vector<Slot>(std::size_t(1) << bits_);
  std::vector<Key> keys_;
};

}  // namespace

PointClusters::PointClusters(
    const std::vector<Eigen::Vector3d>& points, double gap, const SurfaceOptions& options)
{
  const DepthScale depthScale(gap, options);
  Grid grid;
  labels_.reserve(points.size());
  Key last = -1;  // neighbours mostly share a cell
  const double cellsPerMetre = 1.0 / gap;
  for (const auto& p : points)
  {
    const Key cell = keyAt(p.x() * cellsPerMetre, p.y() * cellsPerMetre, depthScale(p.z()));
    labels_.push_back(cell == last ? labels_.back() : grid.numberOf(cell));
    last = cell;
  }
  const auto components = grid.components();
  count_ = components.count;
  for (int& label : labels_) label = components.of[static_cast<std::size_t>(label)];
}

void PointClusters::join(const std::vector<std::pair<int, int>>& pairs)
{
  DisjointSets clusters(static_cast<std::size_t>(count_));
  const auto labelOf = [&](int point) { return labels_[static_cast<std::size_t>(point)]; };
  for (const auto& [a, b] : pairs) clusters.join(labelOf(a), labelOf(b));
  const auto joined = clusters.numbers();
  count_ = joined.count;
  for (int& label : labels_) label = joined.of[static_cast<std::size_t>(label)];
}

}  // namespace quadmap
