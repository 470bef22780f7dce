#pragma once

#include <optional>
#include <vector>

#include "quadmap/estimation/MapObject.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/slam/MapContinuation.h"
#include "quadmap/slam/RelocalizationOptions.h"

namespace quadmap
{
/** Are two objects so alike that they can be one, wherever they are? Labels and sizes; which of the
 * horizontal axes is x plays no part. */
bool areAlike(
    const MapObject& a,
    const MapObject& b,
    const LabelTable& labels,
    const RelocalizationOptions& options);

/** Finds the constellation of `local` in `map` (doc/mathematics.md, "Where in a known map").
 * Nothing when too few objects are found again, or when they could as well be elsewhere: a
 * symmetric room. Deterministic; the order of the objects plays no part beyond ties. */
std::optional<ConstellationMatch> matchConstellation(
    const std::vector<const MapObject*>& local,
    const std::vector<const MapObject*>& map,
    const LabelTable& labels,
    const RelocalizationOptions& options);

}  // namespace quadmap
