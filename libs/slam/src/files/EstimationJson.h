#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "quadmap/base/Json.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
// What report.json tells of the final estimation (doc/formats.md).

/** Its figures, or null when poses were taken as given. */
Json correctionJson(const std::optional<CorrectionSummary>& correction);

/** Places that the run came back to without noticing. */
Json loopsJson(const LoopSummary& loops);

/** The place of the run in the known map and the changes of the room, or null without a map. */
Json mapChangesJson(const std::optional<MapContinuation>& continuation);

}  // namespace quadmap
