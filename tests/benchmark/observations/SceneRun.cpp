#include "SceneRun.h"

#include <algorithm>

#include "quadmap/perception/FramePerception.h"
#include "quadmap/perception/RoomPlanes.h"

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

}  // namespace

void runScene(
    const RunOptions& run,
    const PerceptionOptions& perceptionOptions,
    const LabelTable& labels,
    const std::function<void(const ObservedFrame&)>& visit)
{
  const FramePerception perception(perceptionOptions, labels);
  for (const auto seed : run.seeds)
  {
    simulator::Scene scene = simulator::readScene(simulator::findScene(run.scene));
    scene.options.camera.resize(run.width, run.height);
    const simulator::Simulator room(std::move(scene), labels, seed);
    RoomPlanes known;
    for (std::size_t i = 0; i < room.frameCount(); i += run.framesStep)
    {
      ObservedFrame frame;
      frame.seed = seed;
      frame.index = i;
      frame.simulated = room.frame(i);
      const auto& scan = *frame.simulated.scan;
      frame.T_map_sensor = room.truePoses()[i] + scan.sensorPose;
      frame.boxes = *frame.simulated.objects;
      const Eigen::Vector3d up_sensor =
          frame.T_map_sensor.getRotationMatrix().asEigen().row(2).transpose();
      const auto surfaces =
          perception.measure(scan, frame.boxes, up_sensor, known.around(frame.T_map_sensor));
      known.add(surfaces, frame.T_map_sensor);
      frame.truth = truthOf(frame, room.scene());
      visit(frame);
    }
  }
}

}  // namespace quadmap::observations
