#include "rawlog/BoxBuffer.h"

#include <algorithm>
#include <cmath>

#include "InputError.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kMaxWaiting = 1000;  // most records of one sensor, of a few kB each

constexpr std::size_t kMaxWaitingBytes = 1u << 28;  // most memory of those of all sensors

std::size_t bytesOf(const CObservationObjects& boxes)
{
  std::size_t bytes = sizeof boxes + boxes.coarseDepth.depth.size() * sizeof(float);
  for (const auto& object : boxes.objects)
    bytes += sizeof object + object.label.size() + object.measurement.reason.size() +
             (object.mask ? object.mask->pixels.runEnds().size() * sizeof(std::uint32_t) : 0);
  return bytes;
}

double secondsOf(const BoxBuffer::Entry& e) { return mrpt::Clock::toDouble(e.boxes->timestamp); }

/** What has to be known about a sidecar before it is read along with its rawlog. It is of no use
 * when reading was stopped. */
struct SidecarSurvey
{
  bool hasBoxes = false, damaged = false;
  double stepBack = 0;           // most time by which a record is earlier than one before it [s]
  std::optional<double> latest;  // of the times so far [s]
};

void addTo(SidecarSurvey& survey, const CObservationObjects& boxes)
{
  survey.hasBoxes = true;
  if (boxes.timestamp == INVALID_TIMESTAMP) return;
  const double time = mrpt::Clock::toDouble(boxes.timestamp);
  survey.latest = std::max(time, survey.latest.value_or(time));
  survey.stepBack = std::max(survey.stepBack, *survey.latest - time);
}

/** Goes on behind a broken record, as reading may do. */
SidecarSurvey surveyOf(
    const std::string& file, const RecordLimits& limits, const std::function<bool()>& isStopped)
{
  SidecarSurvey survey;
  RecordReader reader(file, limits, isStopped);
  while (!reader.hasEnded() && !isStopped()) try
    {
      const auto boxes = std::dynamic_pointer_cast<CObservationObjects>(reader.next());
      if (boxes) addTo(survey, *boxes);
    }
    catch (const InputError&)  // it is reported when the file is read
    {
      survey.damaged = true;
    }
  return survey;
}
}  // namespace

void BoxBuffer::openSidecar(const std::string& file, const RecordLimits& limits)
{
  const SidecarSurvey survey = surveyOf(file, limits, isStopped_);
  if (isStopped_() || (!survey.hasBoxes && !survey.damaged)) return;
  sidecar_ = std::make_unique<RecordReader>(file, limits, isStopped_);
  stepBack_ = survey.stepBack;
}

void BoxBuffer::readUntil(double time)
{
  while (sidecar_ && (!sidecarTime_ || *sidecarTime_ <= time + maxDelay_ + stepBack_))
  {
    if (isStopped_()) return;
    const std::size_t record = sidecar_->recordsRead();
    const auto object = sidecar_->next();
    if (!object) return;
    const auto boxes = std::dynamic_pointer_cast<CObservationObjects>(object);
    if (!boxes) continue;
    try
    {
      add({record, boxes});
      const double t = secondsOf({record, boxes});
      sidecarTime_ = std::max(t, sidecarTime_.value_or(t));
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
  latest_[label] = time;  // not the greatest: one wrong clock would end all waiting
  auto& queue = waiting_[label];
  waitingBytes_ += bytesOf(*entry.boxes);
  const auto isLater = [](double t, const Entry& e) { return t < secondsOf(e); };
  queue.insert(std::upper_bound(queue.begin(), queue.end(), time, isLater), std::move(entry));
  // A sidecar is only read as far as needed, but its times may be wrong.
  while (!queue.empty() &&
         (waitingBytes_ > kMaxWaitingBytes || (!sidecar_ && queue.size() > kMaxWaiting)))
    dropFirst(label);
}

BoxBuffer::Entry BoxBuffer::takeOut(const std::string& label, std::deque<Entry>::iterator at)
{
  Entry entry = std::move(*at);
  waiting_[label].erase(at);
  waitingBytes_ -= bytesOf(*entry.boxes);
  return entry;
}

void BoxBuffer::dropFirst(const std::string& label)
{
  takeOut(label, waiting_[label].begin());
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
  while (!queue.empty() && secondsOf(queue.front()) < time - maxDelay_) dropFirst(label);
  const auto delay = [&](const Entry& e) { return std::abs(secondsOf(e) - time); };
  auto best = queue.begin();
  for (auto i = queue.begin(); i != queue.end(); ++i)
    if (delay(*i) < delay(*best)) best = i;
  if (best == queue.end() || delay(*best) > maxDelay_) return std::nullopt;
  ++paired_;
  return takeOut(label, best);
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
