#include "quadmap/maps/FramePairing.h"

#include <algorithm>

namespace quadmap
{
namespace
{
/** Observations of one frame follow each other closely; a scan takes a megabyte or more. */
constexpr std::size_t kWaiting = 4;

template <typename Item>
void keep(std::deque<Item>& items, Item item)
{
  items.push_back(std::move(item));
  while (items.size() > kWaiting) items.pop_front();
}

}  // namespace

std::optional<FramePairing::Frame> FramePairing::add(const mrpt::obs::CObservation3DRangeScan& scan)
{
  auto copy = std::make_shared<const mrpt::obs::CObservation3DRangeScan>(scan);
  auto& waiting = boxes_[scan.sensorLabel];
  const auto it = std::find_if(
      waiting.begin(), waiting.end(),
      [&](const auto& w) { return w.boxes.timestamp == scan.timestamp; });
  if (it == waiting.end())
  {
    keep(scans_[scan.sensorLabel], std::move(copy));
    return {};
  }
  Frame frame{std::move(copy), it->boxes, it->robotPose};
  waiting.erase(it);
  return frame;
}

std::optional<FramePairing::Frame> FramePairing::add(
    const CObservationObjects& boxes, const mrpt::poses::CPose3D& robotPose)
{
  auto& waiting = scans_[boxes.sensorLabel];
  const auto it = std::find_if(
      waiting.begin(), waiting.end(),
      [&](const auto& scan) { return scan->timestamp == boxes.timestamp; });
  if (it == waiting.end())
  {
    keep(boxes_[boxes.sensorLabel], WaitingBoxes{boxes, robotPose});
    return {};
  }
  Frame frame{*it, boxes, robotPose};
  waiting.erase(it);
  return frame;
}

void FramePairing::clear()
{
  scans_.clear();
  boxes_.clear();
}

}  // namespace quadmap
