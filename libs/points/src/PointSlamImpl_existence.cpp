#include <algorithm>

#include "PointSlamImpl.h"
#include "quadmap/estimation/Existence.h"

namespace quadmap
{
template <int D>
bool PointSlamImpl<D>::shouldBeSeen(const PointVector<D>& position, std::size_t pose) const
{
  return visible_ ? visible_(position, pose) : lookedAt_.contains(position);
}

template <int D>
typename PointSlamImpl<D>::Appearance PointSlamImpl<D>::appearanceOf(std::size_t id) const
{
  Appearance result;
  for (std::size_t k = 0; k < frames_.size(); ++k)
  {
    const auto& decisions = frames_[k].decisions;
    if (std::any_of(
            decisions.begin(), decisions.end(),
            [&](const PointDecision& d) { return d.object == id; }))
      ++result.seen;
    else if (shouldBeSeen(poses_[k].inverse() * landmarks_[id].object.position, k))
      ++result.missed;
  }
  return result;
}

template <int D>
void PointSlamImpl<D>::judge()
{
  std::vector<PointVector<D>> measured;
  for (const Frame& frame : frames_)
    for (const auto& z : frame.measurements) measured.push_back(z.position);
  lookedAt_ = LookedAtRegion<D>(measured);
  const Ids ids = mature();
  std::vector<Appearance> appearances;
  double seen = 1, missed = 1;
  for (const std::size_t id : ids)
  {
    appearances.push_back(appearanceOf(id));
    seen += static_cast<double>(appearances.back().seen);
    missed += static_cast<double>(appearances.back().missed);
  }
  // doc/mathematics.md, (18.9). p is half the usual rate, because walls and furniture hide some
  // objects more often than others.
  const double p = visible_
                       ? detectionProbability_
                       : std::max(0.5 * seen / (seen + missed), 2 * options_.falseAlarmProbability);
  const ExistenceEvidence evidence(p, options_.falseAlarmProbability);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    PointObject<D>& object = landmarks_[ids[i]].object;
    object.existenceLogOdds =
        static_cast<double>(appearances[i].seen) * evidence.detection() +
        static_cast<double>(appearances[i].missed) * evidence.miss();  // (18.9)
    object.confirmed =
        object.observations >= unsigned(options_.minObservations) &&
        (options_.associationGiven || object.existenceLogOdds > options_.confirmLogOdds);
  }
}

template class PointSlamImpl<2>;
template class PointSlamImpl<3>;

}  // namespace quadmap
