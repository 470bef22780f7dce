#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
/** What counts as suspicious in a recording. */
struct FolderCheckOptions
{
  double maxGap = 0;  //!< Longest time between frames [s], >= 0; 0 for 5 medians
  /** Least plausible 1st percentile of all depths [m], > 0. Depth cameras see from about 0.4 m on.
   */
  double minDepth = 0.25;
  /** Largest plausible 99th percentile of all depths [m], > minDepth. Depth cameras see up to about
   *  10 m. */
  double maxDepth = 12.0;
  /** A pose jumps when it moves this many times faster than the median, and also faster than
   *  maxSpeed or maxTurnRate_deg [-], > 1. */
  double jumpFactor = 10.0;
  double maxSpeed = 2.0;           //!< Faster than a hand or a robot moves [m/s], > 0
  double maxTurnRate_deg = 180.0;  //!< Faster than a hand or a robot turns [deg/s], > 0
};

/** One text per problem, by kind ("missing file", "depth scale", ...). */
using FolderProblems = std::map<std::string, std::vector<std::string>>;

/** Looks at every file of a recording. It finds missing files, wrong image sizes, an implausible
 * depth scale, depth images without a measurement, gaps and backward jumps in time, boxes and lines
 * of lists that cannot be used, frames without a pose, and poses that are none or jump.
 * \param progress Called with the share that is done, in [0, 1].
 * \exception std::invalid_argument For options out of range. */
FolderProblems checkFolder(
    const FrameFolder& folder,
    const FolderCheckOptions& options,
    const std::function<void(double)>& progress);

}  // namespace quadmap
