#pragma once

#include <mrpt/core/format.h>
#include <mrpt/obs/CObservation.h>

#include <cmath>
#include <stdexcept>

#include "quadmap/obs/Plausible.h"

namespace quadmap
{
/** The time of a record [s]. \exception std::runtime_error If it has none, or one that no recording
 * has. */
inline double timeOfRecord(const mrpt::obs::CObservation& record)
{
  if (record.timestamp == INVALID_TIMESTAMP) throw std::runtime_error("has no time stamp");
  const double time = mrpt::Clock::toDouble(record.timestamp);
  if (!(std::abs(time) <= kLatestTime))
    throw std::runtime_error(mrpt::format("has the time %g s, which is absurd", time));
  return time;
}

}  // namespace quadmap
