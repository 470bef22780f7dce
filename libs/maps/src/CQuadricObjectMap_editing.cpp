#include <mrpt/core/format.h>

#include <algorithm>
#include <stdexcept>

#include "quadmap/base/ArchiveFields.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/obs/Plausible.h"

namespace quadmap
{
namespace
{
/** \exception std::invalid_argument For what a map that is read could not have. */
void requireObject(const Ellipsoid& object)
{
  constexpr double kMaxTilt = 1e-4;  // [rad]: rounding
  if (const auto why = whyNoObject(object))
    throw std::invalid_argument("an object of the map " + *why);
  if (object.rotation().col(2).head<2>().norm() > kMaxTilt)
    throw std::invalid_argument("the objects of the map stand upright, this one is tilted");
}

}  // namespace

CQuadricObjectMap::Entry& CQuadricObjectMap::require(ObjectId id)
{
  const auto it = objects_.find(id);
  if (it == objects_.end()) throw std::out_of_range(mrpt::format("the map has no object %u", id));
  return it->second;
}

ObjectId CQuadricObjectMap::addObject(const MapObject& estimated)
{
  requireObject(estimated.object);
  if (estimated.covariance.llt().info() != Eigen::Success)
    throw std::invalid_argument("the covariance of an object must be positive definite");
  if (estimated.labelCounts.empty() || estimated.observations() == 0)
    throw std::invalid_argument("an object of the map needs observations and their labels");

  Entry object;
  static_cast<MapObject&>(object) = estimated;
  object.id = nextId_++;
  object.object = ellipsoidOf(uprightStateOf(estimated.object));
  weighSize(object);
  object.confirmed = isConfirmed(object);
  object.looks = ExistenceLooks(object.existenceLogOdds);
  object.estimator = ObjectEstimator::fromEstimate(
      {uprightStateOf(object.object), object.covariance, 0, object.orientationDefined},
      labels().properties(object.label()), insertionOptions.estimator);
  objects_[object.id] = object;
  return object.id;
}

void CQuadricObjectMap::merge(ObjectId kept, ObjectId absorbed)
{
  Entry& a = require(kept);
  const Entry& b = require(absorbed);
  if (kept == absorbed)
    throw std::out_of_range(mrpt::format("object %u cannot be merged with itself", kept));

  a.estimator.absorb(
      b.estimator, uprightStateOf(a.object), uprightStateOf(b.object), insertionOptions.estimator);
  for (const auto& [label, count] : b.labelCounts) a.labelCounts[label] += count;
  a.completeCount += b.completeCount;
  a.partialCount += b.partialCount;
  a.missCount = std::min(a.missCount, b.missCount);
  // What was a miss of the one was often a detection of the other: the better record is right.
  if (b.existenceLogOdds > a.existenceLogOdds) a.looks = b.looks;
  a.existenceLogOdds = std::max(a.existenceLogOdds, b.existenceLogOdds);
  a.firstSeen = std::min(a.firstSeen, b.firstSeen);
  a.lastSeen = std::max(a.lastSeen, b.lastSeen);
  for (auto& [instance, object] : objectOfInstance_)
    if (object == absorbed) object = kept;
  for (auto& decision : lastDecisions_)
    if (decision.object == absorbed) decision.object = kept;
  together_.merge(kept, absorbed);
  for (auto& [gone, heir] : heirs_)
    if (heir == absorbed) heir = kept;
  heirs_[absorbed] = kept;
  objects_.erase(absorbed);
  estimate(a, true);
}

void CQuadricObjectMap::setSharedError(ObjectId id, const UprightCovariance& error)
{
  Entry& object = require(id);
  if (!isPositiveSemidefinite(error))
    throw std::invalid_argument(
        "the shared error of an object must be a covariance: symmetric, and without a negative "
        "variance");
  object.covariance += error - object.estimator.sharedError();
  object.estimator.setSharedError(error);
  weighSize(object);
  object.confirmed = isConfirmed(object);
}

const UprightCovariance& CQuadricObjectMap::sharedError(ObjectId id) const
{
  return objects_.at(id).estimator.sharedError();
}

void CQuadricObjectMap::conclude()
{
  for (auto& [id, object] : objects_)
  {
    const bool wasConfirmed = object.confirmed;
    if (object.estimator.setPosesFinal()) estimate(object, false);
    object.confirmed = wasConfirmed;  // letting go makes it less certain, not less likely
    object.covariance -= object.doubts;
    const UprightState at = uprightStateOf(object.object);
    const LabelProperties label = labels().properties(object.label());
    object.doubts = object.estimator.contradictions(at, label, insertionOptions.estimator) +
                    object.estimator.openEnds(at, label, insertionOptions.estimator);
    object.covariance += object.doubts;
    object.estimatedFrom = 0;  // one more observation, and all is open again
  }
}

void CQuadricObjectMap::relabel(ObjectId id, const std::string& label)
{
  Entry& object = require(id);
  if (label.size() > kMaxStoredText)
    throw std::invalid_argument(mrpt::format(
        "the label has %zu bytes, and a map holds at most %zu", label.size(), kMaxStoredText));
  object.labelCounts = {
      {labels().canonical(label), std::max(1u, object.observations())}
  };
  estimate(object, true);  // the label says what sizes are likely, and whether there is a front
}

void CQuadricObjectMap::place(ObjectId id, const Ellipsoid& object)
{
  Entry& entry = require(id);
  requireObject(object);
  entry.object = ellipsoidOf(uprightStateOf(object));
  entry.estimator = ObjectEstimator::fromEstimate(
      {uprightStateOf(entry.object), entry.covariance, 0, entry.orientationDefined},
      labels().properties(entry.label()), insertionOptions.estimator);
  entry.doubts.setZero();  // the estimator knows no more than the whole covariance says
  weighSize(entry);
}

void CQuadricObjectMap::remove(ObjectId id)
{
  require(id);
  objects_.erase(id);
  together_.remove(id);
  for (auto it = heirs_.begin(); it != heirs_.end();)
    it = it->second == id ? heirs_.erase(it) : std::next(it);
  for (auto it = objectOfInstance_.begin(); it != objectOfInstance_.end();)
    it = it->second == id ? objectOfInstance_.erase(it) : std::next(it);
}

// Estimation and merging ---------------------------------------------------------------------

void CQuadricObjectMap::estimate(Entry& object, bool restart)
{
  // Of few measurements the optimum depends on where the search starts.
  constexpr unsigned kFewMeasurements = 10;
  const auto result = object.estimator.estimate(
      uprightStateOf(object.object), labels().properties(object.label()),
      insertionOptions.estimator, restart || object.observations() < kFewMeasurements);
  object.object = ellipsoidOf(result.state);
  object.covariance = result.covariance;
  object.doubts.setZero();
  object.orientationDefined = result.orientationDefined;
  object.isRound = result.isRound;
  object.estimator.setRound(result.isRound);
  weighSize(object);
  object.confirmed = isConfirmed(object);
  object.estimatedFrom = object.observations();
}

bool CQuadricObjectMap::isDue(const Entry& object) const
{
  return object.observations() >= (1 + insertionOptions.estimateGrowth) * object.estimatedFrom;
}

/** Do images tell that two objects are two? Or did what was known before, which is sure of both? */
bool CQuadricObjectMap::areTwoThings(const Entry& a, const Entry& b) const
{
  const auto wasSure = [](const Entry& e) { return e.confirmed && e.estimator.hasPrior(); };
  return (wasSure(a) && wasSure(b)) ||
         together_.showTwoThings(a, b, insertionOptions.merging.maxTogether);
}

/** Merges each touched object with those that are one with it, (13.4) to (13.7). */
void CQuadricObjectMap::mergeOverlapping(std::set<ObjectId> touched)
{
  while (!touched.empty())
  {
    const ObjectId id = *touched.begin();
    touched.erase(touched.begin());
    const Entry& object = objects_.at(id);
    const auto twin = std::find_if(
        objects_.begin(), objects_.end(),
        [&](const auto& other)
        {
          return other.first != id &&
                 areOneObject(object, other.second, labels(), insertionOptions.merging) &&
                 !areTwoThings(object, other.second);
        });
    if (twin == objects_.end()) continue;
    const bool keepsThis =
        object.observations() > twin->second.observations() ||
        (object.observations() == twin->second.observations() && id < twin->first);
    const ObjectId kept = keepsThis ? id : twin->first;
    const ObjectId absorbed = keepsThis ? twin->first : id;
    merge(kept, absorbed);
    touched.erase(absorbed);
    touched.insert(kept);  // it may have grown into another one
  }
}

void CQuadricObjectMap::consolidate()
{
  std::set<ObjectId> all;
  for (auto& [id, object] : objects_)
  {
    estimate(object, true);
    all.insert(id);
  }
  judge(all);
  mergeOverlapping(all);
}

}  // namespace quadmap
