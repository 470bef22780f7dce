#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "quadmap/sensors/TumDataset.h"

namespace quadmap
{
/** What counts as suspicious in a recording. */
struct TumCheckOptions
{
  double maxGap = 0;  //!< Between frames [s], >= 0; 0: five times the median interval
  /** Least plausible 1st percentile of all depths [m], > 0: depth cameras see from about 0.4 m. */
  double minDepth = 0.25;
  /** Largest plausible 99th percentile [m], > minDepth: indoors depth cameras see up to 10 m. */
  double maxDepth = 12.0;
  double jumpFactor = 10.0;        //!< A jump is this much faster than the median [-] and ..., > 1
  double maxSpeed = 2.0;           //!< ... than this [m/s], > 0: a hand or a robot is slower
  double maxTurnRate_deg = 180.0;  //!< ... or turns faster than this [deg/s], > 0
};

/** One text per problem, by kind ("missing file", "depth scale", ...). */
using TumProblems = std::map<std::string, std::vector<std::string>>;

/** Looks at every file of a recording: missing files, image sizes, depth scale, depth images
 * without a measurement, gaps and steps back in time, unusable boxes, frames without pose, poses
 * that jump. \param progress Called with the share done, in [0, 1]. \exception
 * std::invalid_argument For options out of range. */
TumProblems checkTum(
    const TumDataset& dataset,
    const TumCheckOptions& options,
    const std::function<void(double)>& progress);

}  // namespace quadmap
