#pragma once

#include <ostream>

#include "ObservationJson.h"
#include "SceneRun.h"

namespace quadmap::observations
{
/** Prints how good the object map gets with both observation models and with either alone, with and
 * without the rules for box edges: simulator, perception, map and evaluation in memory, at the true
 * poses; mean and standard deviation over the seeds (doc/benchmarks.md, "What each model is
 * worth"). */
Rows printAblationTable(const RunOptions& run, std::ostream& out);

}  // namespace quadmap::observations
