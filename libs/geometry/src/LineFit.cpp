#include "quadmap/geometry/LineFit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kBlocks = 10;
constexpr double kMinPoints = 40;

/** Sums over points (t, a) of a regression of a on t. */
struct Sums
{
  double n = 0, t = 0, a = 0, tt = 0, ta = 0;

  void add(const Eigen::Vector2d& p)
  {
    n += 1;
    t += p.x();
    a += p.y();
    tt += p.x() * p.x();
    ta += p.x() * p.y();
  }
  void add(const Sums& s, double sign)
  {
    n += sign * s.n;
    t += sign * s.t;
    a += sign * s.a;
    tt += sign * s.tt;
    ta += sign * s.ta;
  }
  double spread() const { return tt - t * t / n; }  // n times the variance of t [m^2]
  bool isLine() const { return n >= kMinPoints / 2 && spread() > 1e-6 * n; }
  double slope() const { return (ta - t * a / n) / spread(); }
};

/** One past the last of so many points that belongs to a block. */
std::size_t endOf(std::size_t block, std::size_t points)
{
  return ((block + 1) * points + kBlocks - 1) / kBlocks;
}

struct Blocks
{
  std::array<Sums, kBlocks> parts;
  Sums all;
  double squares = 0;  // of the residuals about the line of selection [m^2]
};

/** Orders points along the line as far as blocks first ... last - 1 need it. */
void sortIntoBlocks(std::vector<Eigen::Vector2d>& points, std::size_t first, std::size_t last)
{
  if (last - first < 2) return;
  const auto at = [&](std::size_t block)
  {
    const std::size_t begin = block == 0 ? 0 : endOf(block - 1, points.size());
    return points.begin() + static_cast<std::ptrdiff_t>(begin);
  };
  const std::size_t middle = (first + last) / 2;
  std::nth_element(
      at(first), at(middle), at(last),
      [](const auto& p, const auto& q)
      { return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y()); });
  sortIntoBlocks(points, first, middle);
  sortIntoBlocks(points, middle, last);
}

/** \param points In the order of blocks. */
Blocks select(const std::vector<Eigen::Vector2d>& points, double offset, double slope, double shell)
{
  Blocks out;
  for (std::size_t block = 0, i = 0; block < kBlocks; ++block)
    for (const std::size_t end = endOf(block, points.size()); i < end; ++i)
    {
      const double residual = points[i].y() - offset - slope * points[i].x();
      if (std::abs(residual) > shell) continue;
      out.parts[block].add(points[i]);
      out.squares += residual * residual;
    }
  for (const auto& part : out.parts) out.all.add(part, 1.0);
  return out;
}

/** The variance of the slope by a block jackknife, equation (8.3). It is no less than what
 * independent noise would give. */
std::optional<double> slopeVariance(const Blocks& blocks)
{
  constexpr double kIndependentShare = 0.25;  // of the points: a depth pixel shares its noise
  double sum = 0, squares = 0;
  for (const auto& part : blocks.parts)
  {
    Sums rest = blocks.all;
    rest.add(part, -1.0);
    if (!rest.isLine()) return {};
    sum += rest.slope();
    squares += rest.slope() * rest.slope();
  }
  const double n = kBlocks;
  const double jackknife = (n - 1) / n * std::max(0.0, squares - sum * sum / n);
  const double white = blocks.squares / blocks.all.n / (kIndependentShare * blocks.all.spread());
  return std::max(jackknife, white);
}

}  // namespace

std::optional<LineFit> fitLine(std::vector<Eigen::Vector2d> points, double shell)
{
  if (static_cast<double>(points.size()) < kMinPoints) return {};
  sortIntoBlocks(points, 0, kBlocks);
  std::vector<double> across;
  across.reserve(points.size());
  for (const auto& p : points) across.push_back(p.y());
  double slope = 0, offset = median(std::move(across));
  Blocks blocks;
  constexpr int kIterations = 5;
  for (int i = 0; i < kIterations; ++i)
  {
    blocks = select(points, offset, slope, i == 0 ? 2.0 * shell : shell);
    if (blocks.all.n < kMinPoints || !blocks.all.isLine()) return {};
    slope = blocks.all.slope();
    offset = (blocks.all.a - slope * blocks.all.t) / blocks.all.n;
  }
  const auto variance = slopeVariance(blocks);
  if (!variance) return {};
  const double stretch = 1.0 + slope * slope;  // d slope / d angle
  return LineFit{
      std::atan(slope), *variance / (stretch * stretch),
      blocks.all.n / static_cast<double>(points.size())};
}

}  // namespace quadmap
