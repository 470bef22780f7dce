#include "merging/MergePlan.h"
#include "quadmap/maps/CQuadricObjectMap.h"

// Two maps of one place as one: section 25 of doc/mathematics.md.
namespace quadmap
{
namespace
{
/** The frames, with the objects that a map takes their boxes for. */
MatchedFrames matchedBy(const CQuadricObjectMap& map, const SessionFrames& frames)
{
  if (!frames) return {};
  return [&map, &frames](const auto& use)
  {
    frames(
        [&](const CObservationObjects& boxes, const mrpt::poses::CPose3D& T_map_robot)
        {
          std::map<std::size_t, ObjectId> objectOfBox;
          for (const auto& decision : map.match(boxes, T_map_robot))
            if (decision.object) objectOfBox[decision.box] = *decision.object;
          use(boxes, T_map_robot, objectOfBox);
        });
  };
}

}  // namespace

MergedMap CQuadricObjectMap::contents() const
{
  MergedMap all;
  for (const auto& [id, object] : objects_)
    all.objects.push_back(
        {object, object.estimator.summary(
                     uprightStateOf(object.object), labels().properties(object.label()),
                     insertionOptions.estimator, object.doubts)});
  return all;
}

std::optional<MapMerge> CQuadricObjectMap::mergeMap(
    const CQuadricObjectMap& other,
    const MapMergeOptions& options,
    const SessionFrames& ownFrames,
    const SessionFrames& otherFrames)
{
  const LabelTable table = labels().completedBy(other.labels());
  const GoneRules rules{table, insertionOptions.existence, insertionOptions.merging, options};
  auto plan = planMerge(
      contents(), other.contents(), matchedBy(*this, ownFrames), matchedBy(other, otherFrames),
      rules, insertionOptions.estimator, options);
  if (!plan) return std::nullopt;
  setLabels(table);
  MapMerge report = std::move(plan->report);
  for (const ObjectId id : plan->removed) remove(id);
  std::map<ObjectId, MapMerge::Origin> origins;
  for (const auto& [id, object] : objects_) origins[id] = {id, id, std::nullopt};
  std::map<ObjectId, ObjectId> come;  // of the other map -> here
  for (const PlannedObject& planned : plan->changed)
  {
    const ObjectId id = planned.origin.id != 0 ? planned.origin.id : nextId_++;
    origins[id] = {id, planned.origin.own, planned.origin.other};
    come[*planned.origin.other] = id;
    take(id, planned);
    // What only the other map has is as sure as that map is of it, whatever this one asks for.
    if (!planned.origin.own) objects_[id].confirmed = planned.object.confirmed;
  }
  for (auto& conflict : report.conflicts)
    if (conflict.origin.id == 0 && conflict.origin.other)
      if (const auto here = come.find(*conflict.origin.other); here != come.end())
        conflict.origin.id = here->second;
  for (const auto& entry : origins) report.origins.push_back(entry.second);
  return report;
}

void CQuadricObjectMap::take(ObjectId id, const PlannedObject& planned)
{
  Entry object;
  static_cast<MapObject&>(object) = planned.object;
  object.id = id;
  object.looks = ExistenceLooks(object.existenceLogOdds);
  object.estimator = ObjectEstimator::fromSummary(planned.known);
  object.estimator.setSharedError(planned.sharedError);
  objects_[id] = object;
  estimate(objects_[id], false);
}

}  // namespace quadmap
