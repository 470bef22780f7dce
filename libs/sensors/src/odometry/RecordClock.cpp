#include "odometry/RecordClock.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <utility>

namespace quadmap
{
namespace
{
constexpr double kFar = 1.0;  // a longer time between two records is no usual one [s]
/** The same for the first record. Nothing before it speaks against it, and a clock may be set soon
 * after the start [s]. */
constexpr double kFarAtStart = 10.0;
}  // namespace

std::string StrayRecord::text() const
{
  return mrpt::format("the time is %.6f s ahead of that of the next record of this sensor", ahead);
}

bool RecordClock::lastIsStray(double next) const
{
  const double far = std::isfinite(latest_) ? kFar : kFarAtStart;
  return unconfirmed_ && next >= latest_ && next < unconfirmed_->time - far;
}

double RecordClock::stepBack(double time) const
{
  return time < last() && !lastIsStray(time) ? last() - time : 0;
}

std::optional<StrayRecord> RecordClock::advance(double time, std::size_t record)
{
  const bool isStray = lastIsStray(time);
  const auto before = std::exchange(unconfirmed_, std::nullopt);
  if (before && !isStray) latest_ = before->time;
  if (time > latest_ + kFar)
    unconfirmed_ = Unconfirmed{time, record};
  else
    latest_ = time;
  if (!isStray) return std::nullopt;
  return StrayRecord{before->record, before->time - time};
}

}  // namespace quadmap
