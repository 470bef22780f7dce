// This file sorts the records of the rawlog. RawlogSource.cpp completes the frames.
#include <mrpt/core/format.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "InputError.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/sensors/RgbdScan.h"
#include "rawlog/RawlogSourceImpl.h"
#include "records/RecordTime.h"

namespace quadmap
{
namespace
{
std::string bareClassName(const mrpt::rtti::CObject& object)
{
  const std::string name = object.GetRuntimeClass()->className;
  const auto colon = name.rfind(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}

}  // namespace

/** Reads one record of the file. \return False at the end of the file, be it clean or not. */
bool RawlogSource::Impl::readRecord()
{
  const std::size_t record = reader.recordsRead();
  try
  {
    const auto object = reader.next();
    if (object) readObject(record, object);
    return object != nullptr;
  }
  catch (const InputError& e)
  {
    report(e.problem);
    return !reader.hasEnded();
  }
}

void RawlogSource::Impl::readObject(
    std::size_t record, const mrpt::serialization::CSerializable::Ptr& object)
{
  using namespace mrpt::obs;
  if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(object))
  {
    for (const auto& observation : *frame) readObservation(record, observation);
    return;
  }
  if (const auto observation = std::dynamic_pointer_cast<CObservation>(object))
    return readObservation(record, observation);
  ++content_[bareClassName(*object)];
  const auto actions = std::dynamic_pointer_cast<CActionCollection>(object);
  if (!actions) return;
  try
  {
    odometry.read(*actions);
  }
  catch (const std::exception& e)
  {
    report({reader.file(), record, "", e.what()});
  }
}

void RawlogSource::Impl::readObservation(
    std::size_t record, const mrpt::obs::CObservation::Ptr& observation)
{
  const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation);
  const auto found = std::dynamic_pointer_cast<CObservationObjects>(observation);
  const std::string& label = observation->sensorLabel;
  ++content_[bareClassName(*observation) + (scan ? " \"" + label + "\"" : "")];
  std::vector<StrayRecord> strays;
  try
  {
    if (scan)
      strays = addScan(record, scan);
    else if (found && !options.readBoxes)
      return;
    else if (found && !boxes.hasSidecar())
      boxes.add({record, found});
    else if (found)
      warnOnce(reader.file() + ": boxes in the rawlog itself are ignored, the sidecar has some");
    else
      strays = odometry.read(record, *observation);
  }
  catch (const std::exception& e)
  {
    return report({reader.file(), record, label, rootMessage(e)});
  }
  for (const auto& stray : strays) report({reader.file(), stray.record, label, stray.text()});
  if (pending_.empty()) odometry.forgetOlderThan(kMaxScanDelay);
  if (!odometry.ignoredKind().empty())
    warnOnce(
        reader.file() + ": poses are taken from " + odometry.kind() + ", not from " +
        odometry.ignoredKind());
}

std::vector<StrayRecord> RawlogSource::Impl::addScan(
    std::size_t record, const mrpt::obs::CObservation3DRangeScan::Ptr& scan)
{
  if (!options.sensorLabel.empty() && scan->sensorLabel != options.sensorLabel) return {};
  const double time = timeOfRecord(*scan);
  PendingFrame pending{{}, odometry.sumOfActions(), imageBytesOf(*scan)};
  pending.frame.record = record;
  pending.frame.scan = scan;
  RecordClock& clock = clocks_[scan->sensorLabel];
  const double last = clock.lastBefore(time);
  if (time == last) throw std::runtime_error("has the time of the scan before");
  if (time < last)
    throw std::runtime_error(
        mrpt::format("time goes backwards: %.6f s before the scan before", last - time));
  auto strays = clock.advance(time, record);
  for (const auto& stray : strays) dropPending(stray, scan->sensorLabel);
  pendingBytes_ += pending.bytes;
  pending_.push_back(std::move(pending));
  return strays;
}

/** Forgets the scan of a record. */
void RawlogSource::Impl::dropPending(const StrayRecord& stray, const std::string& sensor)
{
  const auto isIt = [&](const PendingFrame& p)
  { return p.frame.record == stray.record && p.frame.scan->sensorLabel == sensor; };
  const auto found = std::find_if(pending_.begin(), pending_.end(), isIt);
  if (found == pending_.end()) return;
  pendingBytes_ -= found->bytes;
  pending_.erase(found);
}

std::string RawlogSource::Impl::summary() const
{
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [name, count] : content_) sorted.emplace_back(count, name);
  std::stable_sort(
      sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (const auto& [count, name] : sorted)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  return text.empty() ? "nothing" : text;
}

}  // namespace quadmap
