#include "quadmap/simulator/SimulatedDetector.h"

#include <algorithm>
#include <cmath>

#include "detector/ViewErrors.h"

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
    const auto eye = (frame.T_world_camera - scene.objects[i].poseAt(frame.time)).translation();
    result.push_back({
        i, box, share, frame.outline[i].value_or(box), {eye.x, eye.y, eye.z}
    });
  }
  return result;
}

SimulatedDetector::SimulatedDetector(
    const Scene& scene,
    const DetectorOptions& options,
    const LabelTable& labels,
    std::uint64_t seed) :
    scene_(scene), options_(options), labels_(labels), seed_(seed)
{
  for (const auto& object : scene.objects)
    if (!object.label.empty()) sceneLabels_.push_back(object.label);
  std::sort(sceneLabels_.begin(), sceneLabels_.end());
  sceneLabels_.erase(std::unique(sceneLabels_.begin(), sceneLabels_.end()), sceneLabels_.end());
}

Detections SimulatedDetector::detect(
    const std::vector<VisibleObject>& visible,
    const PinholeCamera& camera,
    RandomStream& random,
    double blur) const
{
  Detections result;
  const auto asTaken = taken(visible);
  for (std::size_t i = 0; i < visible.size(); ++i)
  {
    const VisibleObject& seen = visible[i];
    const double hidden = (1 - seen.visibleShare) / std::max(1e-6, 1 - options_.minVisible);
    const double missRate =
        options_.missRate + hidden * (options_.occludedMissRate - options_.missRate);
    if (random.uniform() < missRate || asTaken[i].isMissed) continue;
    DetectedObject found = detection(asTaken[i], seen, camera, random, blur);
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

std::vector<SimulatedDetector::TakenObject> SimulatedDetector::taken(
    const std::vector<VisibleObject>& visible) const
{
  std::vector<TakenObject> result;
  for (const auto& seen : visible) result.push_back({seen.box, scene_.objects[seen.object].label});
  if (!hasViewErrors(options_)) return result;
  for (std::size_t i = 0; i < visible.size(); ++i)
  {
    const ImageBox& exact = visible[i].box;
    const double w = exact.x2 - exact.x1, h = exact.y2 - exact.y1, size = std::sqrt(w * h);
    const ViewErrors e = viewErrors(options_, seed_, visible[i].object, visible[i].eye);
    TakenObject& object = result[i];
    const bool isHidden = object.isMissed;  // by an object before it
    object.isMissed |= e.isMissed;
    if (e.wrongLabel) object.label = wrongLabel(object.label, *e.wrongLabel);
    object.box = {
        exact.x1 + e.cut[0] * w + e.edges[0] * size, exact.y1 + e.cut[1] * h + e.edges[1] * size,
        exact.x2 - e.cut[2] * w + e.edges[2] * size, exact.y2 - e.cut[3] * h + e.edges[3] * size};
    // Who is hidden has no box that could hide another one; otherwise two would hide each other.
    if (e.isMerged && !isHidden) mergeWithNeighbour(i, visible, result, e.hidesNeighbour);
  }
  return result;
}

/** Neighbours have the same label and boxes that nearly touch. */
void SimulatedDetector::mergeWithNeighbour(
    std::size_t index,
    const std::vector<VisibleObject>& visible,
    std::vector<TakenObject>& taken,
    bool hidesNeighbour) const
{
  constexpr double kGap = 0.2;  // between the boxes, in sizes of the box
  const ImageBox& a = visible[index].box;
  const double gap = kGap * std::sqrt(a.area());
  for (std::size_t j = 0; j < visible.size(); ++j)
  {
    const ImageBox& b = visible[j].box;
    const bool isNear =
        b.x1 < a.x2 + gap && b.x2 > a.x1 - gap && b.y1 < a.y2 + gap && b.y2 > a.y1 - gap;
    const bool isAlike =
        scene_.objects[visible[j].object].label == scene_.objects[visible[index].object].label;
    if (j == index || !isNear || !isAlike) continue;
    taken[index].box = {
        std::min(a.x1, b.x1), std::min(a.y1, b.y1), std::max(a.x2, b.x2), std::max(a.y2, b.y2)};
    taken[j].isMissed |= hidesNeighbour;
    return;
  }
}

DetectedObject SimulatedDetector::detection(
    const TakenObject& taken,
    const VisibleObject& seen,
    const PinholeCamera& camera,
    RandomStream& random,
    double blur) const
{
  constexpr double kBlurSigma = 0.25;  // of an edge, as a share of the blur
  const double sharp = std::hypot(
      options_.jitter * scaleOf(camera), options_.relativeJitter * std::sqrt(seen.box.area()));
  const double sigma = std::hypot(sharp, kBlurSigma * blur);
  DetectedObject found;
  ImageBox box = taken.box;
  for (double* edge : {&box.x1, &box.y1, &box.x2, &box.y2}) *edge += sigma * random.gaussian();
  found.box = box.clipped(camera.width, camera.height);
  found.label = possiblyWrongLabel(taken.label, random);
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

std::string SimulatedDetector::wrongLabel(const std::string& label, double which) const
{
  const auto confused = labels_.properties(label).confusedWith;
  if (confused.empty()) return label;
  return confused[static_cast<std::size_t>(which * static_cast<double>(confused.size()))];
}

}  // namespace quadmap::simulator
