#include <algorithm>
#include <cmath>

#include "quadmap/slam/points/PointSlam.h"

namespace quadmap
{
template <int D>
typename PointSlam<D>::Ids PointSlam<D>::mature() const
{
  Ids ids;
  for (std::size_t id = 0; id < tracks_.size(); ++id)
    if (tracks_[id].alive &&
        tracks_[id].object.observations >= unsigned(options_.matureObservations))
      ids.push_back(id);
  return ids;
}

template <int D>
PointGraph<D> PointSlam<D>::graphOf(const Ids& ids) const
{
  PointGraph<D> graph;
  graph.poses = poses_;
  graph.steps = steps_;
  graph.posesFixed = posesGiven_;
  std::map<std::size_t, std::size_t> indexOf;
  for (const std::size_t id : ids)
  {
    indexOf[id] = graph.objects.size();
    graph.objects.push_back(tracks_[id].object.position);
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
void PointSlam<D>::takeOver(const PointGraph<D>& graph, const Ids& ids)
{
  poses_ = graph.poses;
  for (std::size_t i = 0; i < ids.size(); ++i) tracks_[ids[i]].object.position = graph.objects[i];
}

template <int D>
Constellation PointSlam<D>::likelyDoubles(const Ids& ids, const Eigen::MatrixXd& covariance) const
{
  constexpr std::size_t kMaxTogether = 1;  // frames two doubles are seen in by clutter
  ConstellationProblem problem;
  std::map<std::size_t, std::size_t> indexOf;
  for (const std::size_t id : ids)
  {
    indexOf[id] = problem.objects.size();
    const auto& object = tracks_[id].object;
    problem.objects.push_back({object.position, object.labelCounts});
  }
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> together;
  for (const Frame& frame : frames_)
    for (const auto& a : frame.decisions)
      for (const auto& b : frame.decisions)
        if (a.object && b.object && indexOf.count(*a.object) && indexOf.count(*b.object))
          if (const auto i = indexOf[*a.object], j = indexOf[*b.object]; i < j)
            if (++together[{i, j}] > kMaxTogether) problem.distinct.insert({i, j});
  problem.covariance = covariance;
  problem.density = world().density;
  problem.beta = options_.beta;
  problem.labels = labelsSeen();
  return bestConstellation(problem);
}

template <int D>
bool PointSlam<D>::isWorthMerging(const Constellation& doubles, double logOdds) const
{
  return doubles.logOdds > logOdds &&
         doubles.logOdds - doubles.logOddsSecond > std::min(options_.mergeMargin, logOdds);
}

template <int D>
void PointSlam<D>::absorb(std::size_t kept, std::size_t absorbed)
{
  for (Frame& frame : frames_)
  {
    const bool isTaken = std::any_of(
        frame.decisions.begin(), frame.decisions.end(),
        [&](const PointDecision& d) { return d.object == kept; });
    for (PointDecision& d : frame.decisions)
    {
      if (d.object != absorbed) continue;
      d.object = isTaken ? std::nullopt : std::optional(kept);
      d.startedObject = false;
    }
  }
  tracks_[kept].lastFrame = std::max(tracks_[kept].lastFrame, tracks_[absorbed].lastFrame);
  tracks_[absorbed].alive = false;
  recount();
}

template <int D>
void PointSlam<D>::recount()
{
  for (Track& track : tracks_)
  {
    track.object.observations = 0;
    track.object.labelCounts.clear();
  }
  for (const Frame& frame : frames_)
    for (std::size_t m = 0; m < frame.decisions.size(); ++m)
      if (const auto& object = frame.decisions[m].object)
      {
        ++tracks_[*object].object.observations;
        ++tracks_[*object].object.labelCounts[frame.measurements[m].label];
      }
}

template <int D>
bool PointSlam<D>::mergeDoubles(double logOdds, double& cost)
{
  const Ids ids = mature();
  const auto marginals = graphOf(ids).marginals(options_.huber);
  const Constellation doubles = likelyDoubles(ids, marginals.objects);
  if (!isWorthMerging(doubles, logOdds)) return false;

  const auto poses = poses_;
  const auto frames = frames_;
  const auto tracks = tracks_;
  for (const auto& [kept, absorbed] : doubles.pairs) absorb(ids[kept], ids[absorbed]);
  const Ids left = mature();
  PointGraph<D> graph = graphOf(left);
  const double merged = graph.optimise(options_.huber, options_.maxIterations);
  // What it was expected to cost is in the odds; what it costs counts.
  if (doubles.logOdds + doubles.misfit - (merged - cost) > logOdds)
  {
    takeOver(graph, left);
    cost = merged;
    return true;
  }
  poses_ = poses;
  frames_ = frames;
  tracks_ = tracks;
  return false;
}

template <int D>
bool PointSlam<D>::reassociate(const Ids& ids)
{
  const PointGraph<D> graph = graphOf(ids);
  const auto marginals = graph.marginals(options_.huber);
  bool anyChanged = false;
  std::vector<std::vector<PointDecision>> decisions;
  for (std::size_t k = 0; k < frames_.size(); ++k)
  {
    const Frame& frame = frames_[k];
    Innovations innovations(frame.measurements.size());
    for (std::size_t m = 0; m < frame.measurements.size(); ++m)
      for (std::size_t i = 0; i < ids.size(); ++i)
      {
        const auto o = D * static_cast<Eigen::Index>(i);
        innovations[m].push_back(innovationOf<D>(
            {graph.poses[k], graph.objects[i], marginals.pose[k],
             marginals.poseObjects[k].template middleCols<D>(o),
             marginals.objects.template block<D, D>(o, o)},
            frame.measurements[m]));
      }
    decisions.push_back(decide(frame, ids, innovations));
    for (std::size_t m = 0; m < frame.decisions.size(); ++m)
    {
      decisions.back()[m].startedObject = frame.decisions[m].startedObject &&
                                          decisions.back()[m].object == frame.decisions[m].object;
      anyChanged |= decisions.back()[m].object != frame.decisions[m].object;
    }
  }
  for (std::size_t k = 0; k < frames_.size(); ++k) frames_[k].decisions = std::move(decisions[k]);
  for (std::size_t id = 0; id < tracks_.size(); ++id)
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) tracks_[id].alive = false;
  recount();
  return anyChanged;
}

template <int D>
void PointSlam<D>::estimateConfirmed()
{
  Ids ids;
  for (const std::size_t id : mature())
    if (tracks_[id].object.confirmed) ids.push_back(id);
  estimate(ids);
  const Eigen::MatrixXd covariance = graphOf(ids).marginals(options_.huber).objects;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const auto o = D * static_cast<Eigen::Index>(i);
    tracks_[ids[i]].object.covariance = covariance.block<D, D>(o, o);
  }
}

template <int D>
void PointSlam<D>::finish()
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
      // Nothing more is to come that could tell: in the end the likelier is taken.
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
PointResult<D> PointSlam<D>::result() const
{
  PointResult<D> result = outcome_;
  result.poses = poses_;
  std::map<std::size_t, std::size_t> indexOf;
  for (std::size_t id = 0; id < tracks_.size(); ++id)
  {
    if (!tracks_[id].alive) continue;
    indexOf[id] = result.objects.size();
    result.objects.push_back(tracks_[id].object);
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

template class PointSlam<2>;
template class PointSlam<3>;

}  // namespace quadmap
