#include "odometry/RecordClock.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace quadmap
{
namespace
{
constexpr double kFar = 1.0;  // a longer time between two records is a jump [s]
/** The same for the first record. Nothing before it speaks against it, and a clock may be set soon
 * after the start [s]. */
constexpr double kFarAtStart = 10.0;
constexpr std::size_t kConfirming = 10;  // as many records on the new time confirm a jump
/** So does this share of the time it skipped. Thus rare records, which jump each time, do not wait
 * for ten others. */
constexpr double kConfirmingShare = 0.5;
}  // namespace

std::string StrayRecord::text() const
{
  return mrpt::format(
      "the time is %.6f s ahead of that of record %zu of this sensor", ahead, later);
}

/** How many of the unconfirmed records stay when one of this time follows. */
std::size_t RecordClock::kept(double time) const
{
  const auto isLater = [](double t, const Unconfirmed& u) { return t < u.time; };
  const auto first = std::upper_bound(unconfirmed_.begin(), unconfirmed_.end(), time, isLater);
  if (first == unconfirmed_.end()) return unconfirmed_.size();
  const bool isAtStart = first == unconfirmed_.begin() && !std::isfinite(latest_);
  const bool isStray = time >= latest_ && first->time > time + (isAtStart ? kFarAtStart : kFar);
  return isStray ? static_cast<std::size_t>(std::distance(unconfirmed_.begin(), first))
                 : unconfirmed_.size();
}

double RecordClock::lastBefore(double time) const
{
  const std::size_t count = kept(time);
  return count == 0 ? latest_ : unconfirmed_[count - 1].time;
}

std::vector<StrayRecord> RecordClock::advance(double time, std::size_t record)
{
  std::vector<StrayRecord> strays;
  const auto firstStray = std::next(unconfirmed_.begin(), static_cast<std::ptrdiff_t>(kept(time)));
  for (auto stray = firstStray; stray != unconfirmed_.end(); ++stray)
    strays.push_back({stray->record, record, stray->time - time});
  unconfirmed_.erase(firstStray, unconfirmed_.end());
  unconfirmed_.push_back({time, record});
  confirm();
  return strays;
}

/** Whether the first of the unconfirmed records, all of which may be strays, can be one. */
bool RecordClock::firstMayBeStray() const
{
  const double first = unconfirmed_.front().time;
  const double jump = std::isfinite(latest_) ? first - latest_ : kFarAtStart;
  return jump > kFar && unconfirmed_.size() <= kConfirming &&
         unconfirmed_.back().time - first < kConfirmingShare * jump;
}

/** Lets the first records count, up to a jump that has not lasted yet. */
void RecordClock::confirm()
{
  while (!unconfirmed_.empty() && !firstMayBeStray())
  {
    latest_ = unconfirmed_.front().time;
    unconfirmed_.pop_front();
  }
}

}  // namespace quadmap
