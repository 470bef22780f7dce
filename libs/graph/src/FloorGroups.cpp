#include "FloorGroups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace quadmap
{
namespace
{
constexpr double kUnjoined = 1e6;  // variance of a step that nobody measured [m^2]
constexpr double kGate = 9.0;      // three standard deviations, squared
constexpr double kStorey = 2.2;    // the lowest ones of buildings [m]

/** The poses, one of each thing, that are nearest to each other along the trajectory. */
std::pair<std::size_t, std::size_t> nearestPoses(
    const std::vector<std::size_t>& a, const std::vector<std::size_t>& b)
{
  std::pair<std::size_t, std::size_t> best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();)
  {
    const std::size_t apart = std::max(a[i], b[j]) - std::min(a[i], b[j]);
    if (apart < least)
    {
      least = apart;
      best = {a[i], b[j]};
    }
    a[i] < b[j] ? ++i : ++j;
  }
  return best;
}

/** The squared difference of two bottoms over its variance. */
double difference(const StandingThing& a, const StandingThing& b, const HeightDrift& drift)
{
  const auto [ofA, ofB] = nearestPoses(a.poses, b.poses);
  const double between =
      ofA <= ofB ? drift.variance(ofA, ofB, b.place) : drift.variance(ofB, ofA, a.place);
  const double apart = a.bottom - b.bottom;
  if (std::abs(apart) > kStorey / 2) return kGate;  // nearer to another storey, however it drifts
  return apart * apart / (a.variance + b.variance + between);
}

}  // namespace

void HeightDrift::add(const Eigen::Vector2d& position, const mrpt::poses::CPose3DPDFGaussian* step)
{
  Sums sums = sums_.empty() ? Sums() : sums_.back();
  if (step)
  {
    const auto variances = step->cov.asEigen().diagonal();
    const double angle = variances.tail<3>().mean();
    sums.height += variances.head<3>().mean();
    sums.angle += angle;
    sums.anglePlace += angle * position;
    sums.anglePlaceSquare += angle * position.squaredNorm();
  }
  else if (!sums_.empty())
    sums.height += kUnjoined;
  sums_.push_back(sums);
}

double HeightDrift::variance(std::size_t from, std::size_t to, const Eigen::Vector2d& at) const
{
  if (from == to) return 0;
  const Sums &a = sums_.at(from), &b = sums_.at(to);
  const double turned = at.squaredNorm() * (b.angle - a.angle) -
                        2 * at.dot(b.anglePlace - a.anglePlace) + b.anglePlaceSquare -
                        a.anglePlaceSquare;
  return b.height - a.height + std::max(0.0, turned);
}

std::vector<std::size_t> floorsOf(
    const std::vector<StandingThing>& things, const HeightDrift& drift)
{
  std::vector<std::size_t> order(things.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(
      order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return things[a].variance < things[b].variance; });
  std::vector<std::size_t> floors(things.size(), 0);
  std::size_t found = 0;
  for (auto next = order.begin(); next != order.end(); ++next)
  {
    double best = kGate;
    floors[*next] = found;
    for (auto known = order.begin(); known != next; ++known)
      if (const double d = difference(things[*next], things[*known], drift); d < best)
      {
        best = d;
        floors[*next] = floors[*known];
      }
    if (floors[*next] == found) ++found;
  }
  return floors;
}

}  // namespace quadmap
