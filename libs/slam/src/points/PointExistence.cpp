#include <algorithm>
#include <cmath>

#include "quadmap/slam/points/PointSlam.h"

namespace quadmap
{
namespace
{
constexpr double kNearby = 0.5;  // [m] in the robot's frame

template <int D>
std::size_t countNearby(const PointVector<D>& position, const std::vector<PointVector<D>>& measured)
{
  return static_cast<std::size_t>(std::count_if(
      measured.begin(), measured.end(),
      [&](const PointVector<D>& z) { return (z - position).squaredNorm() < kNearby * kNearby; }));
}

}  // namespace

template <int D>
void PointSlam<D>::surveyView()
{
  view_.measured.clear();
  for (const Frame& frame : frames_)
    for (const auto& z : frame.measurements) view_.measured.push_back(z.position);
  std::vector<std::size_t> counts;
  for (const auto& position : view_.measured)
    counts.push_back(countNearby<D>(position, view_.measured));
  if (counts.empty()) return;
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  view_.usual = *middle;
}

template <int D>
bool PointSlam<D>::shouldBeSeen(const PointVector<D>& position, std::size_t pose) const
{
  constexpr std::size_t kFew = 10;  // measurements nearby that tell nothing
  if (visible_) return visible_(position, pose);
  const std::size_t nearby = countNearby<D>(position, view_.measured);
  return nearby >= kFew && 2 * nearby >= view_.usual;
}

template <int D>
typename PointSlam<D>::Appearance PointSlam<D>::appearanceOf(std::size_t id) const
{
  Appearance result;
  for (std::size_t k = 0; k < frames_.size(); ++k)
  {
    const auto& decisions = frames_[k].decisions;
    if (std::any_of(
            decisions.begin(), decisions.end(),
            [&](const PointDecision& d) { return d.object == id; }))
      ++result.seen;
    else if (shouldBeSeen(poses_[k].inverse() * tracks_[id].object.position, k))
      ++result.missed;
  }
  return result;
}

template <int D>
void PointSlam<D>::judge()
{
  surveyView();
  const Ids ids = mature();
  std::vector<Appearance> appearances;
  double seen = 1, missed = 1;
  for (const std::size_t id : ids)
  {
    appearances.push_back(appearanceOf(id));
    seen += static_cast<double>(appearances.back().seen);
    missed += static_cast<double>(appearances.back().missed);
  }
  // Walls and furniture hide some objects more often than others: half the usual rate.
  const double p = visible_
                       ? options_.detectionProbability
                       : std::max(0.5 * seen / (seen + missed), 2 * options_.falseAlarmProbability);
  const double forIt = std::log(p / options_.falseAlarmProbability);
  const double against = std::log((1 - p) / (1 - options_.falseAlarmProbability));
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    PointObject<D>& object = tracks_[ids[i]].object;
    object.existenceLogOdds = static_cast<double>(appearances[i].seen) * forIt +
                              static_cast<double>(appearances[i].missed) * against;
    object.confirmed =
        object.observations >= unsigned(options_.minObservations) &&
        (options_.associationGiven || object.existenceLogOdds > options_.confirmLogOdds);
  }
}

template void PointSlam<2>::judge();
template void PointSlam<3>::judge();

}  // namespace quadmap
