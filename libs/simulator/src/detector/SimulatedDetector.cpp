#include "quadmap/simulator/SimulatedDetector.h"

#include <algorithm>
#include <cmath>

namespace quadmap::simulator
{
namespace
{
double scaleOf(const PinholeCamera& camera) { return camera.width / 640.0; }

/** Number of pixels of an object in the image, and their bounds. */
struct Footprint
{
  double pixels = 0;
  int u1 = 1 << 20, v1 = 1 << 20, u2 = -1, v2 = -1;
};

std::vector<Footprint> footprints(const RenderedFrame& frame, std::size_t objects)
{
  std::vector<Footprint> result(objects);
  const int width = static_cast<int>(frame.camera.width);
  const int height = static_cast<int>(frame.camera.height);
  std::size_t i = 0;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u, ++i)
    {
      if (frame.object[i] == RenderedFrame::kRoom) continue;
      Footprint& f = result[static_cast<std::size_t>(frame.object[i])];
      ++f.pixels;
      f.u1 = std::min(f.u1, u);
      f.u2 = std::max(f.u2, u);
      f.v1 = std::min(f.v1, v);
      f.v2 = std::max(f.v2, v);
    }
  return result;
}

}  // namespace

std::vector<VisibleObject> visibleObjects(
    const Scene& scene, const RenderedFrame& frame, const DetectorOptions& options)
{
  std::vector<VisibleObject> result;
  const auto found = footprints(frame, scene.objects.size());
  const double minSize = options.minSize * scaleOf(frame.camera);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const Footprint& f = found[i];
    if (scene.objects[i].label.empty() || f.pixels == 0) continue;
    const ImageBox box{
        static_cast<double>(f.u1), static_cast<double>(f.v1), static_cast<double>(f.u2),
        static_cast<double>(f.v2)};
    const double share = std::min(1.0, f.pixels / frame.outlinePixels[i]);
    if (share < options.minVisible || std::sqrt(box.area()) < minSize) continue;
    result.push_back({i, box, share, frame.outline[i].value_or(box)});
  }
  return result;
}

SimulatedDetector::SimulatedDetector(
    const Scene& scene, const DetectorOptions& options, const LabelTable& labels) :
    scene_(scene), options_(options), labels_(labels)
{
  for (const auto& object : scene.objects)
    if (!object.label.empty()) sceneLabels_.push_back(object.label);
  std::sort(sceneLabels_.begin(), sceneLabels_.end());
  sceneLabels_.erase(std::unique(sceneLabels_.begin(), sceneLabels_.end()), sceneLabels_.end());
}

Detections SimulatedDetector::detect(
    const std::vector<VisibleObject>& visible,
    const PinholeCamera& camera,
    RandomStream& random) const
{
  Detections result;
  for (const auto& seen : visible)
  {
    const double hidden = (1 - seen.visibleShare) / std::max(1e-6, 1 - options_.minVisible);
    const double missRate =
        options_.missRate + hidden * (options_.occludedMissRate - options_.missRate);
    if (random.uniform() < missRate) continue;
    DetectedObject found = detection(seen, camera, random);
    if (!found.box.isValid()) continue;
    result.boxes.push_back(std::move(found));
    result.truth.emplace_back(seen.object);
    if (options_.instanceIds)
      result.boxes.back().instanceId = static_cast<std::uint32_t>(seen.object);
  }
  // The integer part of `falseAlarms` always happens, and one more with the rest as probability.
  const double alarms = options_.falseAlarms;
  const int count = static_cast<int>(alarms) + (random.uniform() < alarms - std::floor(alarms));
  for (int i = 0; i < count && !sceneLabels_.empty(); ++i)
    result.boxes.push_back(falseAlarm(camera, random));
  result.truth.resize(result.boxes.size());
  return result;
}

DetectedObject SimulatedDetector::detection(
    const VisibleObject& seen, const PinholeCamera& camera, RandomStream& random) const
{
  const double sigma = std::hypot(
      options_.jitter * scaleOf(camera), options_.relativeJitter * std::sqrt(seen.box.area()));
  DetectedObject found;
  ImageBox box = seen.box;
  for (double* edge : {&box.x1, &box.y1, &box.x2, &box.y2}) *edge += sigma * random.gaussian();
  found.box = box.clipped(camera.width, camera.height);
  found.label = possiblyWrongLabel(scene_.objects[seen.object].label, random);
  const double certainty = 0.55 + 0.4 * seen.visibleShare;
  found.score = std::clamp(certainty + 0.05 * random.gaussian(), 0.3, 0.99);
  return found;
}

DetectedObject SimulatedDetector::falseAlarm(
    const PinholeCamera& camera, RandomStream& random) const
{
  const double w = camera.width * random.uniform(0.05, 0.3);
  const double h = camera.height * random.uniform(0.05, 0.4);
  const double x = random.uniform(0, camera.width - 1 - w);
  const double y = random.uniform(0, camera.height - 1 - h);
  DetectedObject alarm;
  alarm.box = {x, y, x + w, y + h};
  alarm.label = sceneLabels_[random.below(sceneLabels_.size())];
  alarm.score = random.uniform(0.3, 0.6);
  return alarm;
}

std::string SimulatedDetector::possiblyWrongLabel(
    const std::string& label, RandomStream& random) const
{
  const bool flip = random.uniform() < options_.flipRate;
  const auto confused = labels_.properties(label).confusedWith;
  if (!flip || confused.empty()) return label;
  return confused[random.below(confused.size())];
}

}  // namespace quadmap::simulator
