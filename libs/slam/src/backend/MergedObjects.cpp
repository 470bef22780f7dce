#include "MergedObjects.h"

#include <algorithm>
#include <utility>

#include "quadmap/estimation/ViewRedundancy.h"

namespace quadmap
{
void followMerged(const CQuadricObjectMap& map, FactorGraph& graph, CamerasOf& cameras)
{
  for (const auto& [absorbed, heir] : map.heirs())
  {
    if (const auto places = cameras.find(absorbed); places != cameras.end())
    {
      for (const auto& camera : places->second) rememberCamera(camera, cameras[heir]);
      cameras.erase(places);
    }
    if (!graph.hasObject(absorbed)) continue;
    const MapObject& kept = *map.find(heir);
    if (!graph.hasObject(heir))
      graph.setObject(heir, kept.object, propertiesOf(kept, map.labels()));
    graph.removeObject(absorbed, heir);
  }
}

void followMerged(const CQuadricObjectMap& map, std::vector<BoxDecision>& decisions)
{
  const auto& heirs = map.heirs();
  if (heirs.empty()) return;
  for (BoxDecision& box : decisions)
    if (auto& object = box.decision.object; object)
      if (const auto heir = heirs.find(*object); heir != heirs.end()) object = heir->second;
}

std::map<ObjectId, ObjectId> heirsOf(
    const std::vector<BoxDecision>& before, const std::vector<BoxDecision>& after)
{
  using Box = std::pair<std::size_t, std::size_t>;  // keyframe, box
  std::map<Box, ObjectId> now;
  for (const auto& d : after)
    if (d.decision.object) now[{d.keyframe, d.decision.box}] = *d.decision.object;
  std::map<ObjectId, std::map<ObjectId, std::size_t>> votes;
  for (const auto& d : before)
  {
    const auto heir = now.find({d.keyframe, d.decision.box});
    if (d.decision.object && heir != now.end()) ++votes[*d.decision.object][heir->second];
  }
  std::map<ObjectId, ObjectId> heirs;
  for (const auto& [object, counts] : votes)
    heirs[object] = std::max_element(
                        counts.begin(), counts.end(),
                        [](const auto& a, const auto& b) { return a.second < b.second; })
                        ->first;
  return heirs;
}

}  // namespace quadmap
