#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "PointSlamImpl.h"
#include "quadmap/estimation/Association.h"

namespace quadmap
{
namespace
{
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/** Squared distance that 99.9 % of the right measurements keep [variances]. */
template <int D>
constexpr double kGate = D == 2 ? 13.82 : 16.27;

}  // namespace

template <int D>
typename PointSlamImpl<D>::World PointSlamImpl<D>::world() const
{
  constexpr double kMargin = 0.5;  // around all poses and objects [m]
  PointVector<D> lower = poses_.front().t, upper = lower;
  double n = 0;
  const auto include = [&](const PointVector<D>& p)
  {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  };
  for (const auto& pose : poses_) include(pose.t);
  for (const Landmark& landmark : landmarks_)
  {
    if (!landmark.alive || landmark.object.observations < unsigned(options_.matureObservations))
      continue;
    include(landmark.object.position);
    n += 1;
  }
  World result;
  result.volume = ((upper - lower).array() + 2 * kMargin).prod();
  result.density = std::max(n, 1.0) / result.volume;
  return result;
}

template <int D>
unsigned PointSlamImpl<D>::labelsSeen() const
{
  std::set<std::string> labels;
  for (const Landmark& landmark : landmarks_)
    for (const auto& [label, n] : landmark.object.labelCounts) labels.insert(label);
  return static_cast<unsigned>(std::max<std::size_t>(labels.size(), 1));
}

template <int D>
std::vector<AssociationTarget> PointSlamImpl<D>::targetsFor(
    const Frame& frame, const Ids& ids) const
{
  std::vector<AssociationTarget> targets;
  for (const std::size_t id : ids)
  {
    const PointObject<D>& object = landmarks_[id].object;
    unsigned observations = object.observations;
    auto labelCounts = object.labelCounts;
    for (std::size_t k = 0; k < frame.decisions.size(); ++k)
    {
      if (frame.decisions[k].object != id) continue;
      --observations;
      --labelCounts[frame.measurements[k].label];
    }
    targets.emplace_back();
    targets.back().observations = observations;
    for (const auto& [label, n] : labelCounts) targets.back().labelCounts.emplace_back(label, n);
  }
  return targets;
}

template <int D>
Eigen::MatrixXd PointSlamImpl<D>::logLikelihoods(
    const Frame& frame, const Innovations& innovations, double density) const
{
  const auto rows = static_cast<Eigen::Index>(innovations.size());
  const auto columns = static_cast<Eigen::Index>(rows ? innovations.front().size() : 0);
  Eigen::MatrixXd log = Eigen::MatrixXd::Constant(rows, columns, kImpossible);
  for (std::size_t k = 0; k < innovations.size(); ++k)
    for (std::size_t i = 0; i < innovations[k].size(); ++i)
    {
      const PointInnovation<D>& seen = innovations[k][i];
      const double distance = seen.difference.dot(seen.covariance.llt().solve(seen.difference));
      if (distance > kGate<D>) continue;
      // doc/mathematics.md, (18.3): expected number of other objects where this one may be.
      const double confusion = density * std::sqrt((2 * M_PI * seen.state).determinant());
      const bool isClear = confusion <= options_.maxConfusion ||
                           seen.state.trace() <= 2 * frame.measurements[k].covariance.trace();
      if (isClear)
        log(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
            logGaussian(seen.difference, seen.covariance);
    }
  return log;
}

template <int D>
std::vector<PointDecision> PointSlamImpl<D>::decide(
    const Frame& frame, const Ids& ids, const Innovations& innovations) const
{
  const World world = this->world();
  AssociationParameters parameters;
  parameters.alpha = options_.alpha;
  parameters.beta = options_.beta;
  parameters.labels = labelsSeen();
  parameters.minJoinPosterior = options_.minJoinPosterior;
  parameters.newObjectVolume = world.volume;

  std::vector<AssociationCandidate> candidates(frame.measurements.size());
  for (std::size_t k = 0; k < candidates.size(); ++k)
    candidates[k].label = frame.measurements[k].label;

  std::vector<PointDecision> result;
  for (const auto& d : associateFrame(
           candidates, targetsFor(frame, ids), parameters,
           logLikelihoods(frame, innovations, world.density)))
  {
    PointDecision decision;
    if (d.target) decision.object = ids[*d.target];
    decision.startedObject = d.startsObject && d.logPosterior > d.logPosteriorSecond;
    decision.logPosterior = d.logPosterior;
    decision.logPosteriorSecond = d.logPosteriorSecond;
    result.push_back(decision);
  }
  return result;
}

template <int D>
std::vector<PointDecision> PointSlamImpl<D>::decideAsGiven(const Frame& frame)
{
  std::vector<PointDecision> result(frame.measurements.size());
  std::set<std::uint32_t> seen;
  for (std::size_t k = 0; k < result.size(); ++k)
  {
    result[k].logPosteriorSecond = kImpossible;
    const auto& instance = frame.measurements[k].instance;
    if (!instance || !seen.insert(*instance).second) continue;
    const auto known = landmarkOf_.find(*instance);
    if (known != landmarkOf_.end())
      result[k].object = known->second;
    else
      result[k].startedObject = true;
  }
  return result;
}

template <int D>
bool PointSlamImpl<D>::reassociate(const Ids& ids)
{
  const PointGraph<D> graph = graphOf(ids);
  bool anyChanged = false;
  std::vector<std::vector<PointDecision>> decisions(frames_.size());
  const auto decideAgain = [&](std::size_t k, const auto& marginal, const Eigen::MatrixXd& objects)
  {
    const Frame& frame = frames_[k];
    Innovations innovations(frame.measurements.size());
    for (std::size_t m = 0; m < frame.measurements.size(); ++m)
      for (std::size_t i = 0; i < ids.size(); ++i)
      {
        const auto o = D * static_cast<Eigen::Index>(i);
        innovations[m].push_back(innovationOf<D>(
            {graph.poses[k], graph.objects[i], marginal.pose,
             marginal.poseObjects.template middleCols<D>(o), objects.template block<D, D>(o, o)},
            frame.measurements[m]));
      }
    decisions[k] = decide(frame, ids, innovations);
    for (std::size_t m = 0; m < frame.decisions.size(); ++m)
    {
      PointDecision& decision = decisions[k][m];
      decision.startedObject =
          frame.decisions[m].startedObject && decision.object == frame.decisions[m].object;
      anyChanged |= decision.object != frame.decisions[m].object;
    }
    return true;
  };
  graph.marginals(options_.huber, decideAgain);
  for (std::size_t k = 0; k < frames_.size(); ++k) frames_[k].decisions = std::move(decisions[k]);
  for (std::size_t id = 0; id < landmarks_.size(); ++id)
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) landmarks_[id].alive = false;
  recount();
  return anyChanged;
}

template class PointSlamImpl<2>;
template class PointSlamImpl<3>;

}  // namespace quadmap
