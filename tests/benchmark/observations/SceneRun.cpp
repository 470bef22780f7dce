#include "SceneRun.h"

#include <algorithm>

#include "quadmap/perception/RoomPerception.h"
#include "quadmap/rooms/RandomRoom.h"

namespace quadmap::observations
{
namespace
{
std::vector<std::optional<TrueObject>> truthOf(
    const ObservedFrame& frame, const simulator::Scene& scene)
{
  std::vector<std::optional<TrueObject>> out;
  const auto& visible = frame.simulated.visible;
  for (const auto& index : frame.simulated.truthOfBox)
  {
    out.emplace_back();
    if (!index) continue;
    const auto seen = std::find_if(
        visible.begin(), visible.end(), [&](const auto& v) { return v.object == *index; });
    if (seen == visible.end()) continue;
    const auto& object = scene.objects[*index];
    out.back() = TrueObject{
        *index,
        object.name,
        object.label,
        object.truth().transformed(-frame.T_map_sensor),
        object.orientationDefined,
        *seen};
  }
  return out;
}

simulator::Scene sceneOf(const std::string& name, std::uint64_t seed)
{
  if (name == "random") return simulator::randomRoom(seed);
  return simulator::readScene(simulator::findScene(name));
}

}  // namespace

void runScene(
    const RunOptions& run,
    const PerceptionOptions& perceptionOptions,
    const LabelTable& labels,
    const std::function<void(const ObservedFrame&)>& visit)
{
  for (const auto seed : run.seeds)
  {
    simulator::Scene scene = sceneOf(run.scene, seed);
    scene.options.camera.resize(run.width, run.height);
    const simulator::Simulator room(std::move(scene), labels, seed);
    RoomPerception perception(perceptionOptions, labels);
    for (std::size_t i = 0; i < room.frameCount(); i += run.framesStep)
    {
      ObservedFrame frame;
      frame.seed = seed;
      frame.index = i;
      frame.simulated = room.frame(i);
      const auto& scan = *frame.simulated.scan;
      frame.T_map_sensor = room.truePoses()[i] + scan.sensorPose;
      frame.boxes = *frame.simulated.objects;
      perception.measure(scan, frame.boxes, frame.T_map_sensor);
      frame.truth = truthOf(frame, room.scene());
      visit(frame);
    }
  }
}

}  // namespace quadmap::observations
