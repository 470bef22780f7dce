#include "SightedObjects.h"

#include <algorithm>
#include <map>

#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
namespace
{
constexpr unsigned kFewestViews = 5;  // of an object that counts
}

std::vector<SightedObject> sightedObjects(const SlamResult& result)
{
  std::map<ObjectId, std::set<std::size_t>> keyframesOf;
  for (const auto& [keyframe, decision] : result.decisions)
    if (decision.object) keyframesOf[*decision.object].insert(keyframe);
  std::vector<SightedObject> sighted;
  for (const auto& [id, keyframes] : keyframesOf)
  {
    const MapObject* object = result.map.find(id);
    if (!object || object->observations() < kFewestViews) continue;
    const auto distance = [&result, center = object->object.center()](std::size_t k)
    { return (positionOf(result.keyframes[k].T_map_robot) - center).norm(); };
    const auto nearest = std::min_element(
        keyframes.begin(), keyframes.end(),
        [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    sighted.push_back({object, keyframes, *nearest});
  }
  return sighted;
}

}  // namespace quadmap
