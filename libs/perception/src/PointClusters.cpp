#include "PointClusters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace quadmap
{
namespace
{
/** Depth counted in cells that grow with the noise: the integral of dz / max(gap, 2 sigma(z)). */
class DepthScale
{
 public:
  DepthScale(double gap, const PerceptionOptions& options) : gap_(gap)
  {
    constexpr double kSigmas = 2.0;
    const double floor = kSigmas * options.depthSigmaFloor;
    const double growth = kSigmas * options.depthSigmaGrowth;
    if (floor > gap_) gap_ = floor;
    if (!(growth > 0)) return;
    from_ = kNearest + std::sqrt((gap_ - floor) / growth);
    width_ = 1.0 / std::sqrt(floor * growth);
    slope_ = std::sqrt(growth / floor);
  }

  double operator()(double z) const
  {
    if (z < from_) return z / gap_;
    return from_ / gap_ +
           width_ * (std::atan(slope_ * (z - kNearest)) - std::atan(slope_ * (from_ - kNearest)));
  }

 private:
  static constexpr double kNearest = 0.4;  // where PerceptionOptions::depthSigma begins to grow [m]
  double gap_;
  double from_ = 1e9;  // depth from which the noise decides [m]
  double width_ = 0, slope_ = 0;
};

std::int64_t keyOf(const Eigen::Vector3i& cell)
{
  constexpr std::int64_t kOffset = 1 << 20;
  return ((cell.x() + kOffset) << 42) | ((cell.y() + kOffset) << 21) | (cell.z() + kOffset);
}

/** The occupied cells of the grid, each with a number, in an open hash table: most of the time goes
 * into looking up neighbours. */
class Grid
{
 public:
  explicit Grid(std::size_t maxCells)
  {
    while ((std::size_t(1) << bits_) < 2 * maxCells) ++bits_;
    slots_.resize(std::size_t(1) << bits_);
  }

  std::size_t size() const { return cells_.size(); }

  int numberOf(const Eigen::Vector3i& cell)
  {
    const std::int64_t key = keyOf(cell);
    Slot& slot = slots_[slotOf(key)];
    if (slot.number < 0)
    {
      slot = {key, static_cast<int>(cells_.size())};
      cells_.push_back(cell);
    }
    return slot.number;
  }

  /** Gives `label` to every cell without one that hangs together with cell `seed`. */
  void flood(int seed, int label, std::vector<int>& component) const
  {
    std::vector<int> stack = {seed};
    component[static_cast<std::size_t>(seed)] = label;
    while (!stack.empty())
    {
      const Eigen::Vector3i cell = cells_[static_cast<std::size_t>(stack.back())];
      stack.pop_back();
      for (int i = 0; i < 27; ++i)
      {
        const std::int64_t key = keyOf(cell + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
        const int number = slots_[slotOf(key)].number;
        if (number < 0 || component[static_cast<std::size_t>(number)] >= 0) continue;
        component[static_cast<std::size_t>(number)] = label;
        stack.push_back(number);
      }
    }
  }

 private:
  struct Slot
  {
    std::int64_t key = 0;
    int number = -1;  // free
  };

  /** Where a key is, or the free slot where it belongs. */
  std::size_t slotOf(std::int64_t key) const
  {
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15u;  // 2^64 over the golden ratio
    std::size_t slot = (static_cast<std::uint64_t>(key) * kGolden) >> (64 - bits_);
    while (slots_[slot].number >= 0 && slots_[slot].key != key)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  unsigned bits_ = 4;  // of the number of slots
  std::vector<Slot> slots_;
  std::vector<Eigen::Vector3i> cells_;
};

}  // namespace

PointClusters::PointClusters(
    const std::vector<Eigen::Vector3d>& points, double gap, const PerceptionOptions& options)
{
  const DepthScale depthScale(gap, options);
  Grid grid(points.size());
  labels_.reserve(points.size());
  Eigen::Vector3i last(0, 0, 0);  // neighbours mostly share a cell
  const double cellsPerMetre = 1.0 / gap;
  for (const auto& p : points)
  {
    const Eigen::Vector3d position(p.x() * cellsPerMetre, p.y() * cellsPerMetre, depthScale(p.z()));
    const Eigen::Vector3i cell = position.array().floor().cast<int>();
    labels_.push_back(!labels_.empty() && cell == last ? labels_.back() : grid.numberOf(cell));
    last = cell;
  }
  std::vector<int> component(grid.size(), -1);
  for (std::size_t seed = 0; seed < component.size(); ++seed)
    if (component[seed] < 0) grid.flood(static_cast<int>(seed), count_++, component);
  for (int& label : labels_) label = component[static_cast<std::size_t>(label)];
}

void PointClusters::join(const std::vector<std::pair<int, int>>& pairs)
{
  // The cluster that each one was joined to: always one with a smaller number.
  std::vector<int> parent(static_cast<std::size_t>(count_));
  std::iota(parent.begin(), parent.end(), 0);
  const auto rootOf = [&](int point)
  {
    int label = labels_[static_cast<std::size_t>(point)];
    while (parent[static_cast<std::size_t>(label)] != label)
      label = parent[static_cast<std::size_t>(label)];
    return label;
  };
  for (const auto& [a, b] : pairs)
  {
    const int i = rootOf(a), j = rootOf(b);
    parent[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
  }
  std::vector<int> number(parent.size());
  count_ = 0;
  for (std::size_t i = 0; i < parent.size(); ++i)
    number[i] =
        parent[i] == static_cast<int>(i) ? count_++ : number[static_cast<std::size_t>(parent[i])];
  for (int& label : labels_) label = number[static_cast<std::size_t>(label)];
}

}  // namespace quadmap
