#include "quadmap/quadric/QuadricObjects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "quadmap/estimation/Association.h"
#include "quadmap/estimation/Existence.h"
#include "quadmap/estimation/ObjectRules.h"
#include "quadmap/estimation/ViewRedundancy.h"
#include "quadmap/geometry/RotationVector.h"
#include "quadmap/geometry/ViewAngles.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
/** Number of views of a track that are kept. More of them tell nothing new while the track is seen
 * from one direction. */
constexpr std::size_t kMaxTrackViews = 40;
/** Two objects that are seen side by side in more than this share of their keyframes are two. */
constexpr double kMaxSideBySide = 0.1;

std::vector<PosedView> posed(
    const std::vector<BoxView>& views, const QuadricObjects::PoseOf& poseOf)
{
  std::vector<PosedView> out;
  for (const auto& view : views) out.push_back({&view, poseOf(view.keyframe)});
  return out;
}

std::vector<PlacedBox> placed(
    const std::vector<BoxView>& views, const QuadricObjects::PoseOf& poseOf)
{
  std::vector<PlacedBox> out;
  for (const auto& view : views) out.push_back(view.placedAt(poseOf(view.keyframe)));
  return out;
}

std::set<std::size_t> keyframesOf(const QuadricObject& object)
{
  std::set<std::size_t> keyframes;
  for (const auto& view : object.views) keyframes.insert(view.keyframe);
  return keyframes;
}

/** True when one image often has a box of each: the boxes of one image show different things. */
bool areSeenSideBySide(const QuadricObject& a, const QuadricObject& b)
{
  const auto inA = keyframesOf(a), inB = keyframesOf(b);
  const auto both =
      std::count_if(inA.begin(), inA.end(), [&](std::size_t k) { return inB.count(k) != 0; });
  return static_cast<double>(both) >
         kMaxSideBySide * static_cast<double>(std::min(inA.size(), inB.size()));
}

void count(QuadricObject& object)
{
  object.record.labelCounts.clear();
  for (const auto& view : object.views) ++object.record.labelCounts[view.label];
  object.record.partialCount = static_cast<unsigned>(object.views.size());
}

/** Covariance of an object whose axes were renamed. Its turns are about the axes of the map and
 * stay. */
QuadricCovariance renamed(
    const QuadricCovariance& covariance, const std::array<Eigen::Index, 3>& order)
{
  Eigen::PermutationMatrix<9> P(9);
  P.setIdentity();
  for (Eigen::Index i = 0; i < 3; ++i)
    P.indices()[6 + order[static_cast<std::size_t>(i)]] = static_cast<int>(6 + i);
  return P * covariance * P.transpose();
}

/** The same object with its axes named so, turned upright the shortest way. */
Ellipsoid upright(const Ellipsoid& named)
{
  const Eigen::Matrix3d R = named.rotation();
  const Eigen::Vector3d x = turnToZ(R.col(2)) * R.col(0);
  const Eigen::Vector3d c = named.center();
  return {CPose3D(c.x(), c.y(), c.z(), std::atan2(x.y(), x.x()), 0, 0), named.semiAxes()};
}

}  // namespace

QuadricObjects::QuadricObjects(const InsertionOptions& options, const LabelTable& labels) :
    options_(options), labels_(labels)
{
}

Eigen::MatrixXd QuadricObjects::likelihoods(
    const std::vector<BoxView>& views,
    const Eigen::Matrix<double, 6, 6>& poseCovariance,
    const PoseOf& poseOf) const
{
  Eigen::MatrixXd log(views.size(), objects_.size());
  for (std::size_t k = 0; k < views.size(); ++k)
  {
    const BoxView& view = views[k];
    const PosedView seen{&view, poseOf(view.keyframe)};
    Eigen::Index i = 0;
    for (const auto& [id, object] : objects_)
    {
      double& value = log(static_cast<Eigen::Index>(k), i++);
      value = boxLogLikelihoodRatio(
          seen, object.record.object, object.covariance, poseCovariance, options_);
      value += labelLogLikelihood(
          labelAgreement(object.record, view.label, labels_), options_.agreement);
      if (options_.useInstanceIds && view.instance)
        value = view.instance == object.instance ? 1e6 : -std::numeric_limits<double>::infinity();
    }
  }
  return log;
}

std::vector<QuadricObjects::Decision> QuadricObjects::add(
    const std::vector<BoxView>& views,
    mrpt::Clock::time_point time,
    const Eigen::Matrix<double, 6, 6>& poseCovariance,
    const PoseOf& poseOf)
{
  std::vector<ObjectId> ids;
  std::vector<AssociationTarget> targets;
  for (const auto& [id, object] : objects_)
  {
    ids.push_back(id);
    targets.push_back({object.record.observations(), {}});
    targets.back().labelCounts.assign(
        object.record.labelCounts.begin(), object.record.labelCounts.end());
  }
  std::vector<AssociationCandidate> candidates;
  for (const auto& view : views) candidates.push_back({view.label, true});
  AssociationParameters parameters = options_.association;
  parameters.newObjectVolume = 1;  // the likelihoods are ratios to that of "anywhere"

  std::vector<Decision> decisions;
  for (const auto& d :
       associateFrame(candidates, targets, parameters, likelihoods(views, poseCovariance, poseOf)))
  {
    const BoxView& view = views[d.measurement];
    Decision decision;
    decision.box = view.box;
    decision.logPosterior = d.logPosterior;
    decision.logPosteriorSecond = d.logPosteriorSecond;
    const ObjectId id = d.target ? ids[*d.target] : startTrack(view, time, poseOf);
    QuadricObject& object = objects_.at(id);
    if (d.target) addView(object, view, time);
    if (!object.settled &&
        static_cast<double>(object.views.size()) >=
            (1 + options_.estimateGrowth) * static_cast<double>(object.estimated))
      estimate(object, poseOf);
    decision.startedObject = object.waits && promote(object, poseOf);
    if (!object.waits) decision.object = id;
    decisions.push_back(decision);
  }
  forgetOldTracks();
  return decisions;
}

ObjectId QuadricObjects::startTrack(
    const BoxView& view, mrpt::Clock::time_point time, const PoseOf& poseOf)
{
  const ObjectId id = nextId_++;
  QuadricObject& track = objects_[id];
  track.record.id = id;
  track.record.firstSeen = time;
  track.record.object = usualObjectIn(view, poseOf(view.keyframe), labels_.properties(view.label));
  addView(track, view, time);
  return id;
}

void QuadricObjects::addView(
    QuadricObject& object, const BoxView& view, mrpt::Clock::time_point time)
{
  object.views.push_back(view);
  object.record.lastSeen = time;
  if (view.instance) object.instance = view.instance;
  if (object.settled) return;
  if (object.waits && object.views.size() > kMaxTrackViews)
    object.views.erase(object.views.begin() + 1);
  count(object);
}

void QuadricObjects::estimate(QuadricObject& object, const PoseOf& poseOf)
{
  const auto estimate = estimateQuadric(
      posed(object.views, poseOf), object.record.object, labels_.properties(object.record.label()),
      options_);
  object.record.object = estimate.object;
  object.covariance = estimate.covariance;
  object.estimated = object.views.size();
}

bool QuadricObjects::promote(QuadricObject& track, const PoseOf& poseOf)
{
  if (track.views.size() < static_cast<std::size_t>(options_.waiting.minViews)) return false;
  const auto boxes = placed(track.views, poseOf);
  const auto center = triangulatedCenter(boxes);
  if (!center || parallax(*center, camerasOf(boxes)) < options_.waiting.minParallax) return false;

  const auto label = labels_.properties(track.record.label());
  const auto plausible = [&](const Ellipsoid& object)
  { return isPlausible(object, boxes, label, options_.existence.maxSizeDeviation); };
  std::vector<Ellipsoid> starts = {track.record.object};
  if (const auto linear = ellipsoidTouching(boxes); linear && plausible(*linear))
    starts.push_back(*linear);
  const double radius = 0.5 * std::cbrt(label.typicalSize.prod());
  starts.emplace_back(
      CPose3D(center->x(), center->y(), center->z(), 0, 0, 0), Eigen::Vector3d::Constant(radius));
  std::optional<QuadricEstimate> best;
  for (const Ellipsoid& start : starts)
  {
    auto estimate = estimateQuadric(posed(track.views, poseOf), start, label, options_);
    if (plausible(estimate.object) && (!best || estimate.cost < best->cost))
      best = std::move(estimate);
  }
  if (!best) return false;
  const RenamedAxes named = withAxesNamedUpright(best->object);
  track.record.object = named.object;
  track.covariance = renamed(best->covariance, named.order);
  track.estimated = track.views.size();
  track.waits = false;
  return true;
}

void QuadricObjects::forgetOldTracks()
{
  std::vector<std::pair<mrpt::Clock::time_point, ObjectId>> tracks;
  for (const auto& [id, object] : objects_)
    if (object.waits) tracks.emplace_back(object.record.lastSeen, id);
  const auto capacity = static_cast<std::size_t>(options_.waiting.capacity);
  if (tracks.size() <= capacity) return;
  std::sort(tracks.begin(), tracks.end());
  for (std::size_t i = 0; i + capacity < tracks.size(); ++i) objects_.erase(tracks[i].second);
}

std::vector<std::pair<ObjectId, ObjectId>> QuadricObjects::mergeOverlapping(const PoseOf& poseOf)
{
  std::vector<std::pair<ObjectId, ObjectId>> merged;
  for (auto a = objects_.begin(); a != objects_.end(); ++a)
    for (auto b = std::next(a); b != objects_.end();)
    {
      QuadricObject &kept = a->second, &absorbed = b->second;
      if (kept.waits || absorbed.waits ||
          (options_.useInstanceIds && kept.instance != absorbed.instance) ||
          !areOneObject(kept.record, absorbed.record, labels_, options_.merging) ||
          areSeenSideBySide(kept, absorbed))
      {
        ++b;
        continue;
      }
      if (absorbed.views.size() > kept.views.size())
        kept.record.object = absorbed.record.object;  // the better first guess
      MapObject &record = kept.record, &other = absorbed.record;
      record.firstSeen = std::min(record.firstSeen, other.firstSeen);
      record.lastSeen = std::max(record.lastSeen, other.lastSeen);
      kept.views.insert(kept.views.end(), absorbed.views.begin(), absorbed.views.end());
      kept.settled = false;
      count(kept);
      estimate(kept, poseOf);
      merged.emplace_back(a->first, b->first);
      b = objects_.erase(b);
    }
  return merged;
}

void QuadricObjects::beginRound()
{
  for (auto it = objects_.begin(); it != objects_.end();)
  {
    it->second.views.clear();
    it->second.settled = true;
    it = it->second.waits ? objects_.erase(it) : std::next(it);
  }
}

void QuadricObjects::endRound()
{
  for (auto it = objects_.begin(); it != objects_.end();)
  {
    count(it->second);
    const bool stays = !it->second.waits && it->second.views.size() >=
                                                static_cast<std::size_t>(options_.waiting.minViews);
    it = stays ? std::next(it) : objects_.erase(it);
  }
}

void QuadricObjects::settle(
    ObjectId id, const Ellipsoid& object, const QuadricCovariance& covariance)
{
  QuadricObject& known = objects_.at(id);
  known.record.object = object;
  known.covariance = covariance;
  known.settled = true;
}

MapObject QuadricObjects::finished(const QuadricObject& object, const PoseOf& poseOf) const
{
  MapObject out = object.record;
  const RenamedAxes named = withAxesNamedUpright(object.record.object);
  out.object = upright(named.object);
  const QuadricCovariance covariance = renamed(object.covariance, named.order);
  constexpr int kUprightIncrements[] = {0, 1, 2, 5, 6, 7, 8};  // of (d, w, d ln s)
  for (Eigen::Index i = 0; i < 7; ++i)
    for (Eigen::Index j = 0; j < 7; ++j)
      out.covariance(i, j) = covariance(kUprightIncrements[i], kUprightIncrements[j]);
  out.orientationDefined = labels_.properties(out.label()).dominantDirection;

  const auto& existence = options_.existence;
  const auto cameras = camerasOf(placed(object.views, poseOf));
  double independent = 0;
  for (const double share : independentShares(cameras, out.object.center(), existence))
    independent += share;
  out.existenceLogOdds = existenceAfterDetections(0, independent, existence);
  return out;
}

}  // namespace quadmap
