#pragma once

#include <ostream>

#include "ObservationJson.h"
#include "SceneRun.h"

namespace quadmap::observations
{
/** Prints how far the headings that single frames measure are from the truth, per class: what the
 * map starts from. Quarter turns count as equal, as in the evaluation of maps. */
Rows printOrientationTable(const RunOptions& run, std::ostream& out);

}  // namespace quadmap::observations
