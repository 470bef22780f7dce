#include "quadmap/maps/FramePairing.h"

#include <algorithm>

namespace quadmap
{
namespace
{
/** Observations of one frame follow each other closely; a scan takes a megabyte or more. */
constexpr std::size_t kWaiting = 4;

bool sameFrame(const mrpt::obs::CObservation& a, const mrpt::obs::CObservation& b)
{
  return a.timestamp == b.timestamp && a.sensorLabel == b.sensorLabel;
}

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
  const auto it = std::find_if(
      boxes_.begin(), boxes_.end(), [&](const auto& w) { return sameFrame(w.boxes, scan); });
  if (it == boxes_.end())
  {
    keep(scans_, std::move(copy));
    return {};
  }
  Frame frame{std::move(copy), it->boxes, it->robotPose};
  boxes_.erase(it);
  return frame;
}

std::optional<FramePairing::Frame> FramePairing::add(
    const CObservationObjects& boxes, const mrpt::poses::CPose3D& robotPose)
{
  const auto it = std::find_if(
      scans_.begin(), scans_.end(), [&](const auto& scan) { return sameFrame(*scan, boxes); });
  if (it == scans_.end())
  {
    keep(boxes_, WaitingBoxes{boxes, robotPose});
    return {};
  }
  Frame frame{*it, boxes, robotPose};
  scans_.erase(it);
  return frame;
}

void FramePairing::clear()
{
  scans_.clear();
  boxes_.clear();
}

}  // namespace quadmap
