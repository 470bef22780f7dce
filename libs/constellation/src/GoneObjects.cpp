#include "quadmap/constellation/GoneObjects.h"

#include <algorithm>

#include "quadmap/estimation/Existence.h"
#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
namespace
{
/** How much of a box lies outside the outline does not matter here: an object is only gone when
 * nothing can be it. */
constexpr double kMinInside = 0;

}  // namespace

GoneObjects::GoneObjects(
    const Objects& known,
    const Objects& local,
    const ConstellationMatch& match,
    const GoneRules& rules) :
    rules_(rules)
{
  std::set<ObjectId> found;
  for (const auto& [here, there] : match.pairs)
  {
    partnerOf_[here] = there;
    found.insert(there);
  }
  for (const MapObject* object : known)
    if (found.count(object->id) == 0) missing_.push_back(object);
  for (const MapObject* object : local)
  {
    MapObject& moved = local_.emplace(object->id, *object).first->second;
    moved.object = object->object.transformed(match.T_map_local);
  }
}

void GoneObjects::look(
    const CObservationObjects& boxes,
    const mrpt::poses::CPose3D& T_map_robot,
    const std::map<std::size_t, ObjectId>& objectOfBox)
{
  const FrameGeometry frame{
      pinholeFrom(boxes.cameraParams), T_map_robot + boxes.sensorPose, &boxes.coarseDepth};
  const double time = mrpt::Clock::toDouble(boxes.timestamp);
  for (const MapObject* object : missing_)
    if (shouldBeVisible(object->object, frame, rules_.existence, rules_.existence.minBoxSize))
      looks_[object->id].add(
          {positionOf(frame.T_map_sensor), time, isShown(*object, boxes, frame, objectOfBox)},
          object->object.center(), rules_.existence);
}

std::set<ObjectId> GoneObjects::gone() const
{
  std::set<ObjectId> gone;
  for (const MapObject* object : missing_)
  {
    const auto looks = looks_.find(object->id);
    const double logOdds =
        looks == looks_.end()
            ? 0
            : looks->second.logOdds(rules_.existence.detectionProbability, rules_.existence);
    if (hasShifted(*object) || logOdds < -rules_.constellation.minLogOdds) gone.insert(object->id);
  }
  return gone;
}

/** True when something like it is so near that both cannot stand there, and yet is not it. */
bool GoneObjects::hasShifted(const MapObject& object) const
{
  return std::any_of(
      local_.begin(), local_.end(),
      [&](const auto& other)
      {
        return partnerOf_.count(other.first) == 0 &&
               areAlike(other.second, object, rules_.labels, rules_.constellation) &&
               areOneObject(other.second, object, rules_.labels, rules_.merging);
      });
}

/** True when a box where the object should be may show it and shows nothing else that is known. */
bool GoneObjects::isShown(
    const MapObject& object,
    const CObservationObjects& boxes,
    const FrameGeometry& frame,
    const std::map<std::size_t, ObjectId>& objectOfBox) const
{
  const LabelTable& labels = rules_.labels;
  const auto outline = outlineInImage(object, frame, labels);
  if (!outline) return false;
  ShownRule rule;
  rule.minInside = kMinInside;
  rule.minLabelAgreement = rules_.constellation.minLabelAgreement;
  for (std::size_t b = 0; b < boxes.objects.size(); ++b)
  {
    const auto& box = boxes.objects[b];
    if (!mayShow(box.box, labels.canonical(box.label), object, *outline, labels, rule)) continue;
    const auto owner = objectOfBox.find(b);
    if (owner == objectOfBox.end() || mayBe(owner->second, object)) return true;
  }
  return false;
}

/** True when one of the session's objects is at the place of this one, or not sure enough to be
 * elsewhere. */
bool GoneObjects::mayBe(ObjectId localId, const MapObject& object) const
{
  const auto local = local_.find(localId);
  if (local == local_.end()) return true;
  return partnerOf_.count(localId) == 0 &&
         areOneObject(local->second, object, rules_.labels, rules_.merging);
}

}  // namespace quadmap
