#include "PointClusters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

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

/** The occupied cells of the grid, each with a number. */
struct Grid
{
  std::unordered_map<std::int64_t, int> numbers;
  std::vector<Eigen::Vector3i> cells;

  int numberOf(const Eigen::Vector3i& cell)
  {
    const auto [it, isNew] = numbers.try_emplace(keyOf(cell), static_cast<int>(cells.size()));
    if (isNew) cells.push_back(cell);
    return it->second;
  }

  /** Gives `label` to every cell without one that hangs together with cell `seed`. */
  void flood(int seed, int label, std::vector<int>& component) const
  {
    std::vector<int> stack = {seed};
    component[static_cast<std::size_t>(seed)] = label;
    while (!stack.empty())
    {
      const Eigen::Vector3i cell = cells[static_cast<std::size_t>(stack.back())];
      stack.pop_back();
      for (int i = 0; i < 27; ++i)
      {
        const auto it =
            numbers.find(keyOf(cell + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
        if (it == numbers.end() || component[static_cast<std::size_t>(it->second)] >= 0) continue;
        component[static_cast<std::size_t>(it->second)] = label;
        stack.push_back(it->second);
      }
    }
  }
};

}  // namespace

PointClusters::PointClusters(
    const std::vector<Eigen::Vector3d>& points, double gap, const PerceptionOptions& options)
{
  const DepthScale depthScale(gap, options);
  Grid grid;
  for (const auto& p : points)
  {
    const Eigen::Vector3d cell(p.x() / gap, p.y() / gap, depthScale(p.z()));
    labels_.push_back(grid.numberOf(cell.array().floor().cast<int>()));
  }
  std::vector<int> component(grid.cells.size(), -1);
  for (std::size_t seed = 0; seed < component.size(); ++seed)
    if (component[seed] < 0) grid.flood(static_cast<int>(seed), count_++, component);
  for (int& label : labels_) label = component[static_cast<std::size_t>(label)];
}

}  // namespace quadmap
