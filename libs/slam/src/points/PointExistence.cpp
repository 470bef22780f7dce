#include <algorithm>
#include <cmath>

#include "quadmap/slam/points/PointSlam.h"

namespace quadmap
{
template <int D>
bool PointSlam<D>::shouldBeSeen(const PointVector<D>& position, std::size_t pose) const
{
  return visible_ ? visible_(position, pose) : view_.contains(position);
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
  std::vector<PointVector<D>> measured;
  for (const Frame& frame : frames_)
    for (const auto& z : frame.measurements) measured.push_back(z.position);
  view_ = PointView<D>(measured);
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
                       ? detectionProbability_
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
