#include "quadmap/sensors/ResultKeyframes.h"

#include <mrpt/core/format.h>

#include <stdexcept>

namespace quadmap
{
namespace
{
using mrpt::obs::CObservation3DRangeScan;

/** The boxes of a scan among the observations of its keyframe; null when there are none. */
CObservationObjects::Ptr boxesOf(
    const CObservation3DRangeScan& scan, const mrpt::obs::CSensoryFrame& observations)
{
  for (const auto& observation : observations)
    if (auto boxes = std::dynamic_pointer_cast<CObservationObjects>(observation);
        boxes && boxes->sensorLabel == scan.sensorLabel && boxes->timestamp == scan.timestamp)
      return boxes;
  return nullptr;
}

}  // namespace

ResultKeyframes::ResultKeyframes(const std::string& folder, Boxes boxes) :
    path_(folder + "/map.simplemap"), scans_(path_)
{
  if (boxes == Boxes::Ignore) return;
  registerObsClasses();
  boxes_.emplace(folder + "/objects.simplemap");
  objectsOfBoxes_.emplace(folder + "/report.json");
  if (scans_.size() != boxes_->size())
    throw std::runtime_error(
        folder + ": map.simplemap and objects.simplemap are of different runs");
}

std::optional<std::vector<KeyframeScan>> ResultKeyframes::next()
{
  const auto keyframe = scans_.next();
  const auto boxes = boxes_ ? boxes_->next() : std::nullopt;
  if (!keyframe) return std::nullopt;
  ++read_;
  std::vector<KeyframeScan> images;
  for (const auto& observation : *keyframe->observations)
  {
    const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
    if (!scan) continue;
    // A file beside the map could be any file of the user's.
    if (scan->rangeImage_isExternallyStored() || scan->intensityImage.isExternallyStored())
      throw std::runtime_error(mrpt::format(
          "%s: keyframe %zu of %zu: the images of %s are not in it", path_.c_str(), read_,
          scans_.size(), scan->sensorLabel.c_str()));
    KeyframeScan image;
    image.scan = scan;
    image.T_map_robot = keyframe->pose->getMeanVal();
    if (boxes)
    {
      image.boxes = boxesOf(*scan, *boxes->observations);
      image.objectOfBox =
          objectsOfBoxes_->of(scan->sensorLabel, mrpt::Clock::toDouble(scan->timestamp));
    }
    images.push_back(std::move(image));
  }
  return images;
}

}  // namespace quadmap
