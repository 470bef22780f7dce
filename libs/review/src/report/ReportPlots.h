#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/ObjectList.h"
#include "quadmap/review/ReportPage.h"

namespace quadmap
{
/** What the plots of a report show. */
struct ReportTracks
{
  Trajectory odometry, corrected;  //!< In the map, before and after
  std::vector<ObjectRecord> objects;
  std::optional<ReportTruth> truth;
};

/** The trajectories and the objects from above, as inline SVG. */
std::string trackPlot(const ReportTracks& tracks);

/** With a true trajectory the errors of the positions over time, before and after, each aligned by
 * itself, as ATE has them. Without it how far positions were moved. Inline SVG; empty when there
 * are no common times. */
std::string errorPlot(const ReportTracks& tracks);

}  // namespace quadmap
