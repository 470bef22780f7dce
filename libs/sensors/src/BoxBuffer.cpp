#include "BoxBuffer.h"

#include <mrpt/core/format.h>

#include <cmath>

#include "InputError.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kMaxWaiting = 1000;  // records of one sensor; a few kB each

double secondsOf(const BoxBuffer::Entry& e) { return mrpt::Clock::toDouble(e.boxes->timestamp); }
}  // namespace

void BoxBuffer::openSidecar(const std::string& file)
{
  sidecar_ = std::make_unique<RecordReader>(file);
}

void BoxBuffer::readUntil(double time)
{
  while (sidecar_ && (!sidecarTime_ || *sidecarTime_ <= time + maxDelay_))
  {
    const std::size_t record = sidecar_->recordsRead();
    const auto object = sidecar_->next();
    if (!object) return;
    const auto boxes = std::dynamic_pointer_cast<CObservationObjects>(object);
    if (!boxes) continue;
    try
    {
      add({record, boxes});
      sidecarTime_ = secondsOf({record, boxes});
    }
    catch (const std::exception& e)
    {
      throw InputError({sidecar_->file(), record, boxes->sensorLabel, e.what()});
    }
  }
}

void BoxBuffer::add(Entry entry)
{
  seenAny_ = true;
  const std::string label = entry.boxes->sensorLabel;
  if (entry.boxes->timestamp == INVALID_TIMESTAMP)
    throw std::runtime_error("the boxes have no time stamp");
  const double time = secondsOf(entry);
  const auto before = latest_.find(label);
  if (before != latest_.end() && time < before->second)
    throw std::runtime_error(
        mrpt::format("the time of the boxes goes back by %.6f s", before->second - time));
  latest_[label] = time;
  auto& queue = waiting_[label];
  queue.push_back(std::move(entry));
  if (queue.size() <= kMaxWaiting) return;
  queue.pop_front();
  ++dropped_[label];
}

bool BoxBuffer::mayStillCome(const std::string& label, double time) const
{
  const auto latest = latest_.find(label);
  return !sidecar_ && latest != latest_.end() && latest->second < time - maxDelay_;
}

std::optional<BoxBuffer::Entry> BoxBuffer::take(const std::string& label, double time)
{
  auto& queue = waiting_[label];
  while (!queue.empty() && secondsOf(queue.front()) < time - maxDelay_)
  {
    queue.pop_front();
    ++dropped_[label];
  }
  const auto delay = [&](const Entry& e) { return std::abs(secondsOf(e) - time); };
  auto best = queue.begin();
  for (auto i = queue.begin(); i != queue.end(); ++i)
    if (delay(*i) < delay(*best)) best = i;
  if (best == queue.end() || delay(*best) > maxDelay_) return std::nullopt;
  Entry found = std::move(*best);
  queue.erase(best);
  ++paired_;
  return found;
}

std::size_t BoxBuffer::unpaired(const std::string& label) const
{
  std::size_t count = 0;
  for (const auto& [sensor, n] : dropped_)
    if (label.empty() || sensor == label) count += n;
  for (const auto& [sensor, queue] : waiting_)
    if (label.empty() || sensor == label) count += queue.size();
  return count;
}

}  // namespace quadmap
