#include "MergedObjects.h"

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
      graph.setObject(heir, kept.object, map.labels().properties(kept.label()));
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

}  // namespace quadmap
