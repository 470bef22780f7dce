#include "quadmap/slam/points/PointSlam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "quadmap/maps/Association.h"

namespace quadmap
{
namespace
{
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/** Squared distance in standard deviations that 99.9 % of right measurements keep. */
template <int D>
constexpr double kGate = D == 2 ? 13.82 : 16.27;

}  // namespace

template <int D>
PointSlam<D>::PointSlam(
    const PointOptions& options,
    bool posesGiven,
    PointVisibility<D> visible,
    double detectionProbability) :
    options_(options),
    posesGiven_(posesGiven),
    visible_(std::move(visible)),
    detectionProbability_(detectionProbability)
{
}

template <int D>
typename PointSlam<D>::World PointSlam<D>::world() const
{
  constexpr double kMargin = 0.5;  // [m] around what is known
  PointVector<D> lower = poses_.front().t, upper = lower;
  double n = 0;
  const auto include = [&](const PointVector<D>& p)
  {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  };
  for (const auto& pose : poses_) include(pose.t);
  for (const Track& track : tracks_)
  {
    if (!track.alive || track.object.observations < unsigned(options_.matureObservations)) continue;
    include(track.object.position);
    n += 1;
  }
  World result;
  result.volume = ((upper - lower).array() + 2 * kMargin).prod();
  result.density = std::max(n, 1.0) / result.volume;
  return result;
}

template <int D>
unsigned PointSlam<D>::labelsSeen() const
{
  std::set<std::string> labels;
  for (const Track& track : tracks_)
    for (const auto& [label, n] : track.object.labelCounts) labels.insert(label);
  return static_cast<unsigned>(std::max<std::size_t>(labels.size(), 1));
}

template <int D>
std::vector<AssociationTarget> PointSlam<D>::targetsFor(const Frame& frame, const Ids& ids) const
{
  std::vector<AssociationTarget> targets;
  for (const std::size_t id : ids)
  {
    const PointObject<D>& object = tracks_[id].object;
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
Eigen::MatrixXd PointSlam<D>::logLikelihoods(
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
      // How many other objects there may be where this one may be, as seen from the robot.
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
std::vector<PointDecision> PointSlam<D>::decide(
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
  for (const auto& d : associateByLikelihood(
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
std::vector<PointDecision> PointSlam<D>::decideAsGiven(const Frame& frame)
{
  std::vector<PointDecision> result(frame.measurements.size());
  std::set<std::uint32_t> seen;
  for (std::size_t k = 0; k < result.size(); ++k)
  {
    result[k].logPosteriorSecond = kImpossible;
    const auto& instance = frame.measurements[k].instance;
    if (!instance || !seen.insert(*instance).second) continue;
    const auto known = trackOf_.find(*instance);
    if (known != trackOf_.end())
      result[k].object = known->second;
    else
      result[k].startedObject = true;
  }
  return result;
}

template <int D>
void PointSlam<D>::addFrame(
    const PointOdometry<D>& step,
    const std::vector<PointMeasurement<D>>& measurements,
    const PointPose<D>& origin)
{
  if (frames_.empty())
    filter_.reset(origin, {}, 0.0 * Eigen::MatrixXd(PoseStepMatrix<D>::Identity()));
  else
  {
    PointOdometry<D> motion = step;
    if (posesGiven_) motion.covariance.setZero();
    filter_.predict(motion);
    steps_.push_back(step);
  }
  poses_.push_back(filter_.pose());
  frames_.push_back({measurements, {}});
  Frame& frame = frames_.back();

  if (options_.associationGiven)
    frame.decisions = decideAsGiven(frame);
  else
  {
    Innovations innovations(measurements.size());
    for (std::size_t k = 0; k < measurements.size(); ++k)
      for (std::size_t i = 0; i < inFilter_.size(); ++i)
        innovations[k].push_back(filter_.innovation(i, measurements[k]));
    frame.decisions = decide(frame, inFilter_, innovations);
  }
  joinOrStart(frame);
  if (!options_.associationGiven)
  {
    forgetFleeting();
    mergeOnline();
  }
}

template <int D>
void PointSlam<D>::joinOrStart(Frame& frame)
{
  const std::size_t now = frames_.size() - 1;
  const auto count = [&](Track& track, const PointMeasurement<D>& z)
  {
    ++track.object.observations;
    ++track.object.labelCounts[z.label];
    track.lastFrame = now;
  };
  for (std::size_t k = 0; k < frame.decisions.size(); ++k)
  {
    const auto& object = frame.decisions[k].object;
    if (!object) continue;
    const auto at = std::find(inFilter_.begin(), inFilter_.end(), *object);
    filter_.update(static_cast<std::size_t>(at - inFilter_.begin()), frame.measurements[k]);
    count(tracks_[*object], frame.measurements[k]);
  }
  for (std::size_t k = 0; k < frame.decisions.size(); ++k)
  {
    if (!frame.decisions[k].startedObject) continue;
    frame.decisions[k].object = tracks_.size();
    if (frame.measurements[k].instance && options_.associationGiven)
      trackOf_[*frame.measurements[k].instance] = tracks_.size();
    filter_.add(frame.measurements[k]);
    inFilter_.push_back(tracks_.size());
    tracks_.emplace_back();
    tracks_.back().object.instance = frame.measurements[k].instance;
    count(tracks_.back(), frame.measurements[k]);
  }
  poses_.back() = filter_.pose();
  for (std::size_t i = 0; i < inFilter_.size(); ++i)
    tracks_[inFilter_[i]].object.position = filter_.position(i);
}

template <int D>
void PointSlam<D>::forgetFleeting()
{
  const std::size_t now = frames_.size() - 1;
  for (std::size_t i = inFilter_.size(); i-- > 0;)
  {
    Track& track = tracks_[inFilter_[i]];
    const unsigned n = track.object.observations;
    if (n >= unsigned(options_.matureObservations) ||
        now - track.lastFrame < n * std::size_t(options_.forgetAfter))
      continue;
    track.alive = false;
    filter_.remove(i);
    inFilter_.erase(inFilter_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

template <int D>
bool PointSlam<D>::isTimeToMerge() const
{
  constexpr std::size_t kPause = 10;  // frames between two tests when nothing new is mature
  const auto& decisions = frames_.back().decisions;
  return frames_.size() - 1 - lastMergeTest_ >= kPause ||
         std::any_of(
             decisions.begin(), decisions.end(),
             [&](const PointDecision& d)
             {
               return d.object && tracks_[*d.object].object.observations ==
                                      unsigned(options_.matureObservations);
             });
}

template <int D>
Constellation PointSlam<D>::likelyDoublesInFilter() const
{
  Ids ids;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < inFilter_.size(); ++i)
  {
    if (tracks_[inFilter_[i]].object.observations < unsigned(options_.matureObservations)) continue;
    ids.push_back(inFilter_[i]);
    for (int d = 0; d < D; ++d) rows.push_back(kPoseStep<D> + D * static_cast<Eigen::Index>(i) + d);
  }
  return likelyDoubles(ids, filter_.covariance()(rows, rows));
}

template <int D>
double PointSlam<D>::estimate(const Ids& ids)
{
  PointGraph<D> graph = graphOf(ids);
  const double cost = graph.optimise(options_.huber, options_.maxIterations);
  takeOver(graph, ids);
  return cost;
}

template <int D>
void PointSlam<D>::mergeOnline()
{
  if (!isTimeToMerge()) return;
  lastMergeTest_ = frames_.size() - 1;
  if (!isWorthMerging(likelyDoublesInFilter(), options_.mergeLogOdds)) return;

  double cost = estimate(mature());
  while (mergeDoubles(options_.mergeLogOdds, cost))
  {
  }
  inFilter_.erase(
      std::remove_if(
          inFilter_.begin(), inFilter_.end(), [&](std::size_t id) { return !tracks_[id].alive; }),
      inFilter_.end());
  restartFilter();
}

template <int D>
void PointSlam<D>::restartFilter()
{
  estimate(
      inFilter_);  // those seen once or twice, too, are to be where the corrected poses saw them
  const PointGraph<D> graph = graphOf(inFilter_);
  const auto marginals = graph.marginals(options_.huber);
  const Eigen::Index p = kPoseStep<D>, n = marginals.objects.rows();
  Eigen::MatrixXd P(p + n, p + n);
  P << marginals.pose.back(), marginals.poseObjects.back(),
      marginals.poseObjects.back().transpose(), marginals.objects;
  filter_.reset(poses_.back(), graph.objects, P);
}

template class PointSlam<2>;
template class PointSlam<3>;

}  // namespace quadmap
