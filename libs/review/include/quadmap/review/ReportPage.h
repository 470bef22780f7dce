#pragma once

#include <optional>
#include <string>

#include "quadmap/evaluation/EvaluationReport.h"
#include "quadmap/obs/Trajectory.h"

namespace quadmap
{
/** The truth that a run was compared with. */
struct ReportTruth
{
  EvaluationReport figures;
  std::optional<Trajectory> trajectory;  //!< In the world of the truth
  bool inPlace = false;                  //!< Was compared without alignment
  /** Most time between an estimated and a true pose [s], >= 0. */
  double maxTimeDifference = kMaxTimeDifference;
};

/** What happened in a run as one page for any browser: trajectory before and after, errors, boxes
 * and why they were not used, warnings, objects, and time per module. It is complete in itself,
 * needs no script and loads nothing, and text from files stays text.
 * \param folder Has report.json, objects.json, trajectory.tum and trajectory_odometry.tum.
 * \exception std::runtime_error If one of them cannot be read; names it. */
std::string reportPage(
    const std::string& folder, const std::optional<ReportTruth>& truth = std::nullopt);

}  // namespace quadmap
