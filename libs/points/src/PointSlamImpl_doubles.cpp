#include <algorithm>
#include <map>
#include <utility>

#include "PointSlamImpl.h"

namespace quadmap
{
template <int D>
Doubles PointSlamImpl<D>::likelyDoubles(const Ids& ids, const Eigen::MatrixXd& covariance) const
{
  constexpr std::size_t kMaxTogether = 1;  // frames in which clutter may show two doubles at once
  DoublesProblem problem;
  std::map<std::size_t, std::size_t> indexOf;
  for (const std::size_t id : ids)
  {
    indexOf[id] = problem.objects.size();
    const auto& object = landmarks_[id].object;
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
  return bestDoubles(problem);
}

template <int D>
bool PointSlamImpl<D>::isWorthMerging(const Doubles& doubles, double logOdds) const
{
  return doubles.logOdds > logOdds &&
         doubles.logOdds - doubles.logOddsSecond > std::min(options_.mergeMargin, logOdds);
}

template <int D>
bool PointSlamImpl<D>::mergeDoubles(double logOdds, double& cost)
{
  const Ids ids = mature();
  const Doubles doubles = likelyDoubles(ids, graphOf(ids).marginals(options_.huber));
  if (!isWorthMerging(doubles, logOdds)) return false;

  const auto poses = poses_;
  const auto frames = frames_;
  const auto landmarks = landmarks_;
  for (const auto& [kept, absorbed] : doubles.pairs) absorb(ids[kept], ids[absorbed]);
  const Ids left = mature();
  PointGraph<D> graph = graphOf(left);
  const double merged = graph.optimise(options_.huber, options_.maxIterations);
  // doc/mathematics.md, (18.8): the log-odds have the expected growth of the cost, M. It is
  // replaced by the growth that was found.
  if (doubles.logOdds + doubles.misfit - (merged - cost) > logOdds)
  {
    takeOver(graph, left);
    cost = merged;
    return true;
  }
  poses_ = poses;
  frames_ = frames;
  landmarks_ = landmarks;
  return false;
}

template <int D>
void PointSlamImpl<D>::absorb(std::size_t kept, std::size_t absorbed)
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
  landmarks_[kept].lastFrame = std::max(landmarks_[kept].lastFrame, landmarks_[absorbed].lastFrame);
  landmarks_[absorbed].alive = false;
  recount();
}

template <int D>
void PointSlamImpl<D>::recount()
{
  for (Landmark& landmark : landmarks_)
  {
    landmark.object.observations = 0;
    landmark.object.labelCounts.clear();
  }
  for (const Frame& frame : frames_)
    for (std::size_t m = 0; m < frame.decisions.size(); ++m)
      if (const auto& object = frame.decisions[m].object)
      {
        ++landmarks_[*object].object.observations;
        ++landmarks_[*object].object.labelCounts[frame.measurements[m].label];
      }
}

template class PointSlamImpl<2>;
template class PointSlamImpl<3>;

}  // namespace quadmap
