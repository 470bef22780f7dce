#include "SceneRun.h"

#include <algorithm>

#include "quadmap/perception/FramePerception.h"
#include "quadmap/perception/RoomPlanes.h"

namespace quadmap::observations
{
namespace
{
/** Which visible object each box was drawn around: pairs of the greatest overlap first, labels
 * that a detector does not confuse never. */
std::vector<std::optional<std::size_t>> matchBoxes(
    const std::vector<DetectedObject>& boxes,
    const std::vector<simulator::VisibleObject>& visible,
    const simulator::Scene& scene,
    const LabelTable& labels)
{
  constexpr double kMinIoU = 0.4;  // boxes jitter by some pixels; small ones lose much by that
  struct Pair
  {
    double iou;
    std::size_t box, visible;
  };
  std::vector<Pair> pairs;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (std::size_t v = 0; v < visible.size(); ++v)
    {
      const double iou = imageBoxIoU(boxes[b].box, visible[v].box);
      if (iou > kMinIoU &&
          labels.compatible(boxes[b].label, scene.objects[visible[v].object].label))
        pairs.push_back({iou, b, v});
    }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.iou > b.iou; });
  std::vector<std::optional<std::size_t>> out(boxes.size());
  std::vector<bool> taken(visible.size(), false);
  for (const auto& pair : pairs)
    if (!out[pair.box] && !taken[pair.visible])
    {
      out[pair.box] = pair.visible;
      taken[pair.visible] = true;
    }
  return out;
}

std::vector<std::optional<TrueObject>> truthOf(
    const ObservedFrame& frame, const simulator::Scene& scene, const LabelTable& labels)
{
  std::vector<std::optional<TrueObject>> out;
  const auto& visible = frame.simulated.visible;
  for (const auto& match : matchBoxes(frame.boxes.objects, visible, scene, labels))
  {
    out.emplace_back();
    if (!match) continue;
    const std::size_t index = visible[*match].object;
    const auto& object = scene.objects[index];
    out.back() = TrueObject{
        index,
        object.name,
        object.label,
        object.truth().transformed(-frame.T_map_sensor),
        object.orientationDefined,
        visible[*match]};
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
      frame.truth = truthOf(frame, room.scene(), labels);
      visit(frame);
    }
  }
}

}  // namespace quadmap::observations
