#include "quadmap/maps/FramePairing.h"

#include <algorithm>
#include <stdexcept>

#include "quadmap/obs/FrameAgreement.h"

namespace quadmap
{
namespace
{
using mrpt::obs::CObservation3DRangeScan;

/** Observations of one frame follow each other closely; a scan takes a megabyte or more. */
constexpr std::size_t kWaiting = 4;

template <typename Item>
void keep(std::deque<Item>& items, Item item)
{
  items.push_back(std::move(item));
  while (items.size() > kWaiting) items.pop_front();
}

void requireAgreement(const CObservationObjects& boxes, const CObservation3DRangeScan& scan)
{
  requireCalibration(scan.cameraParams, "the scan of sensor \"" + scan.sensorLabel + "\"");
  if (const auto why = mismatch(boxes, scan))
    throw std::invalid_argument("frame of sensor \"" + scan.sensorLabel + "\": " + *why);
}

template <typename Scans>
auto findScan(Scans& scans, mrpt::Clock::time_point time)
{
  return std::find_if(
      scans.begin(), scans.end(), [&](const auto& scan) { return scan->timestamp == time; });
}

}  // namespace

std::optional<FramePairing::Frame> FramePairing::add(const CObservation3DRangeScan& scan)
{
  auto copy = std::make_shared<const CObservation3DRangeScan>(scan);
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
  requireAgreement(frame.boxes, *frame.scan);
  return frame;
}

std::optional<FramePairing::Frame> FramePairing::add(
    const CObservationObjects& boxes, const UncertainPose& robotPose)
{
  auto& waiting = scans_[boxes.sensorLabel];
  const auto it = findScan(waiting, boxes.timestamp);
  if (it == waiting.end())
  {
    keep(boxes_[boxes.sensorLabel], WaitingBoxes{boxes, robotPose});
    return {};
  }
  Frame frame{*it, boxes, robotPose};
  waiting.erase(it);
  requireAgreement(frame.boxes, *frame.scan);
  return frame;
}

CObservation3DRangeScan::ConstPtr FramePairing::scanOf(const CObservationObjects& boxes) const
{
  const auto ofSensor = scans_.find(boxes.sensorLabel);
  if (ofSensor == scans_.end()) return nullptr;
  const auto it = findScan(ofSensor->second, boxes.timestamp);
  if (it == ofSensor->second.end()) return nullptr;
  requireAgreement(boxes, **it);
  return *it;
}

void FramePairing::clear()
{
  scans_.clear();
  boxes_.clear();
}

}  // namespace quadmap
