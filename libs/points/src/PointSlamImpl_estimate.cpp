#include <algorithm>
#include <map>

#include "PointSlamImpl.h"

namespace quadmap
{
template <int D>
typename PointSlamImpl<D>::Ids PointSlamImpl<D>::mature() const
{
  Ids ids;
  for (std::size_t id = 0; id < landmarks_.size(); ++id)
    if (landmarks_[id].alive &&
        landmarks_[id].object.observations >= unsigned(options_.matureObservations))
      ids.push_back(id);
  return ids;
}

template <int D>
PointGraph<D> PointSlamImpl<D>::graphOf(const Ids& ids) const
{
  PointGraph<D> graph;
  graph.poses = poses_;
  graph.steps = steps_;
  graph.posesFixed = posesGiven_;
  std::map<std::size_t, std::size_t> indexOf;
  for (const std::size_t id : ids)
  {
    indexOf[id] = graph.objects.size();
    graph.objects.push_back(landmarks_[id].object.position);
  }
  for (std::size_t k = 0; k < frames_.size(); ++k)
    for (std::size_t m = 0; m < frames_[k].decisions.size(); ++m)
    {
      const auto& object = frames_[k].decisions[m].object;
      const auto index = object ? indexOf.find(*object) : indexOf.end();
      if (index == indexOf.end()) continue;
      const auto& z = frames_[k].measurements[m];
      graph.sights.push_back({k, index->second, z.position, z.covariance});
    }
  return graph;
}

template <int D>
void PointSlamImpl<D>::takeOver(const PointGraph<D>& graph, const Ids& ids)
{
  poses_ = graph.poses;
  for (std::size_t i = 0; i < ids.size(); ++i)
    landmarks_[ids[i]].object.position = graph.objects[i];
}

template <int D>
double PointSlamImpl<D>::estimate(const Ids& ids)
{
  PointGraph<D> graph = graphOf(ids);
  const double cost = graph.optimise(options_.huber, options_.maxIterations);
  takeOver(graph, ids);
  return cost;
}

template <int D>
void PointSlamImpl<D>::estimateConfirmed()
{
  Ids ids;
  for (const std::size_t id : mature())
    if (landmarks_[id].object.confirmed) ids.push_back(id);
  estimate(ids);
  const Eigen::MatrixXd covariance = graphOf(ids).marginals(options_.huber);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const auto o = D * static_cast<Eigen::Index>(i);
    landmarks_[ids[i]].object.covariance = covariance.block<D, D>(o, o);
  }
}

template <int D>
void PointSlamImpl<D>::finish()
{
  if (frames_.empty()) return;
  recount();
  outcome_ = {};
  for (; outcome_.rounds < std::max(options_.rounds, 1) && !outcome_.converged; ++outcome_.rounds)
  {
    const auto before = poses_;
    double cost = estimate(mature());
    bool anyChanged = false;
    if (!options_.associationGiven)
    {
      // No later frame can tell any more, so the likelier alternative is taken in the end.
      for (const double logOdds : {options_.mergeLogOdds, options_.finalMergeLogOdds})
        while (mergeDoubles(logOdds, cost)) anyChanged = true;
      anyChanged |= reassociate(mature());
    }
    outcome_.lastMove = 0;
    for (std::size_t k = 0; k < poses_.size(); ++k)
      outcome_.lastMove = std::max(outcome_.lastMove, (poses_[k].t - before[k].t).norm());
    outcome_.converged = !anyChanged && outcome_.lastMove < options_.smallMove;
  }
  judge();
  estimateConfirmed();
}

template <int D>
PointResult<D> PointSlamImpl<D>::result() const
{
  PointResult<D> result = outcome_;
  result.poses = poses_;
  std::map<std::size_t, std::size_t> indexOf;
  for (std::size_t id = 0; id < landmarks_.size(); ++id)
  {
    if (!landmarks_[id].alive) continue;
    indexOf[id] = result.objects.size();
    result.objects.push_back(landmarks_[id].object);
  }
  for (const Frame& frame : frames_)
  {
    result.decisions.push_back(frame.decisions);
    for (PointDecision& d : result.decisions.back())
    {
      const auto known = d.object ? indexOf.find(*d.object) : indexOf.end();
      d.object = known == indexOf.end() ? std::nullopt : std::optional(known->second);
    }
  }
  return result;
}

template class PointSlamImpl<2>;
template class PointSlamImpl<3>;

}  // namespace quadmap
