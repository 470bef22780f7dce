#include "relocalization/ContinueMap.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "ClaimTogether.h"
#include "KnownObjects.h"
#include "backend/BackEnd.h"
#include "backend/MergedObjects.h"
#include "quadmap/constellation/GoneObjects.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
namespace
{
/** The given map with the options and labels of the run, which carries it on. Labels that only the
 * map knows stay known. */
CQuadricObjectMap preparedMap(const CQuadricObjectMap& given, const CQuadricObjectMap& run)
{
  CQuadricObjectMap map = given;
  map.setLabels(run.labels().completedBy(given.labels()));
  map.insertionOptions = run.insertionOptions;
  map.likelihoodOptions = run.likelihoodOptions;
  map.renderOptions = run.renderOptions;
  map.perceptionOptions = run.perceptionOptions;
  return map;
}

/** The edges between poses and objects, which name the objects of the run's own map, with the ids
 * of the continued one. */
std::vector<FactorGraph::GraphEdge> renamed(
    const std::vector<FactorGraph::GraphEdge>& edges, const std::map<ObjectId, ObjectId>& heirs)
{
  std::vector<FactorGraph::GraphEdge> out;
  for (auto edge : edges)
  {
    const auto heir = heirs.find(edge.object);
    if (heir == heirs.end()) continue;
    edge.object = heir->second;
    out.push_back(edge);
  }
  return out;
}

std::set<ObjectId> idsOf(const std::vector<const MapObject*>& objects)
{
  std::set<ObjectId> ids;
  for (const MapObject* object : objects) ids.insert(object->id);
  return ids;
}

std::vector<ObjectId> without(const std::set<ObjectId>& ids, const std::set<ObjectId>& others)
{
  std::vector<ObjectId> rest;
  std::set_difference(
      ids.begin(), ids.end(), others.begin(), others.end(), std::back_inserter(rest));
  return rest;
}

std::vector<const MapObject*> objectsOf(
    const CQuadricObjectMap& map, const std::vector<ObjectId>& ids)
{
  std::vector<const MapObject*> objects;
  for (const ObjectId id : ids) objects.push_back(map.find(id));
  return objects;
}

/** Takes out of `added` and `removed` what went from one place to the other. */
void pairMoves(
    const CQuadricObjectMap& given,
    const CQuadricObjectMap& now,
    const RelocalizationOptions& options,
    MapContinuation& changes)
{
  changes.moved = movesBetween(
      objectsOf(given, changes.removed), objectsOf(now, changes.added), now.labels(), options);
  std::set<ObjectId> gone, came;
  for (const Move& move : changes.moved)
  {
    gone.insert(move.from);
    came.insert(move.to);
  }
  changes.removed = without({changes.removed.begin(), changes.removed.end()}, gone);
  changes.added = without({changes.added.begin(), changes.added.end()}, came);
}

/** Confirmed objects of the map that the run, whose poses are in its frame, shows to be gone. */
std::set<ObjectId> goneObjects(
    const CQuadricObjectMap& given,
    const SlamResult& run,
    const ConstellationMatch& match,
    const BackEnd::BoxesOf& boxesOf,
    const RelocalizationOptions& options)
{
  const auto& insertion = run.map.insertionOptions;
  GoneObjects objects(
      given.confirmedObjects(), run.map.confirmedObjects(), match,
      {run.map.labels(), insertion.existence, insertion.merging, options});
  std::size_t next = 0;  // decision
  for (std::size_t k = 0; k < run.keyframes.size(); ++k)
  {
    std::map<std::size_t, ObjectId> objectOfBox;
    for (; next < run.decisions.size() && run.decisions[next].keyframe == k; ++next)
      if (const auto& d = run.decisions[next].decision; d.object) objectOfBox[d.box] = *d.object;
    if (const auto boxes = boxesOf(k))
      objects.look(*boxes, run.keyframes[k].T_map_robot, objectOfBox);
  }
  return objects.gone();
}

/** \exception NotLocalised */
ConstellationMatch requireMatch(
    const CQuadricObjectMap& run,
    const CQuadricObjectMap& given,
    const RelocalizationOptions& options)
{
  const auto local = run.confirmedObjects(), known = given.confirmedObjects();
  const auto match = matchConstellation(local, known, run.labels(), options);
  if (match) return *match;
  throw NotLocalised(mrpt::format(
      "it cannot be told where this is in the map: the %zu objects of the recording were "
      "compared with the %zu of the map",
      local.size(), known.size()));
}

/** Corrects a run, whose poses are in the map's frame, by the map's objects.
 * \return Where its objects, then in that frame too, are in the map. Nothing when they can no
 * longer be told there: near the limit the corrected ones may fall below it. `result` is then
 * unchanged. */
std::optional<ConstellationMatch> correctedMatch(
    const CQuadricObjectMap& given,
    BackEnd& backEnd,
    const BackEnd::BoxesOf& boxesOf,
    const RelocalizationOptions& options,
    SlamResult& result)
{
  SlamResult corrected = result;
  try
  {
    backEnd.correctWith(
        [&](const CQuadricObjectMap& local)
        { return priorsOf(local, given, requireMatch(local, given, options).pairs, options); },
        boxesOf, corrected);
    const auto match = requireMatch(corrected.map, given, options);
    result = std::move(corrected);
    return match;
  }
  catch (const NotLocalised&)
  {
    return std::nullopt;
  }
}

MapContinuation changesBetween(
    const CQuadricObjectMap& given,
    const CQuadricObjectMap& now,
    const RelocalizationOptions& options)
{
  MapContinuation changes;
  const auto before = idsOf(given.confirmedObjects()), after = idsOf(now.confirmedObjects());
  changes.knownObjects = before.size();
  changes.added = without(after, before);
  changes.removed = without(before, after);
  pairMoves(given, now, options, changes);
  return changes;
}

}  // namespace

void continueMap(
    const CQuadricObjectMap& given,
    BackEnd& backEnd,
    const std::function<CObservationObjects::Ptr(std::size_t)>& boxesOf,
    const RelocalizationOptions& options,
    SlamResult& finalResult)
{
  ConstellationMatch match = requireMatch(finalResult.map, given, options);
  const auto place = match.T_map_local;
  SlamResult result = finalResult;
  for (auto& keyframe : result.keyframes)
  {
    mrpt::poses::CPose3DPDFGaussian pose(keyframe.T_map_robot);
    if (keyframe.covariance) pose.cov = *keyframe.covariance;
    pose.changeCoordinatesReference(place);
    keyframe.T_map_robot = pose.mean;
    if (keyframe.covariance) keyframe.covariance = pose.cov;
  }
  const auto corrected = correctedMatch(given, backEnd, boxesOf, options, result);
  if (corrected) match = *corrected;
  CQuadricObjectMap map = preparedMap(given, result.map);
  for (const ObjectId id : goneObjects(given, result, match, boxesOf, options)) map.remove(id);

  const std::vector<BoxDecision> before = std::move(result.decisions);
  const CQuadricObjectMap own = std::exchange(result.map, std::move(map));
  result.decisions.clear();
  for (std::size_t k = 0; k < result.keyframes.size(); ++k)
    if (const auto boxes = boxesOf(k))
      BackEnd::insertIntoMap(*boxes, k, result.keyframes[k].T_map_robot, result);
  BackEnd::consolidateMap(result);
  const auto heirs = heirsOf(before, result.decisions);
  result.edges = renamed(result.edges, heirs);
  claimTogether(given, own, heirs, result.map);
  result.continuation = changesBetween(given, result.map, options);
  match.T_map_local = place;
  result.continuation->match = match;
  result.continuation->lostInCorrection = !corrected;
  finalResult = std::move(result);
}

}  // namespace quadmap
