#pragma once

#include <ostream>

#include "ObservationJson.h"
#include "SceneRun.h"

namespace quadmap::observations
{
/** Prints, for each type of factor of the map's estimator, how its residuals at the true state are
 * distributed in units of the sigma the factor claims (doc/benchmarks.md, "Honest sigmas").
 * \param perLabel One row per factor and label too. \param raw When not null: every residual. */
Rows printResidualTable(const RunOptions& run, bool perLabel, std::ostream& out, std::ostream* raw);

}  // namespace quadmap::observations
