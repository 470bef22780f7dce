#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <utility>
#include <vector>

#include "quadmap/maps/MapObject.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/slam/relocalization/RelocalizationOptions.h"

namespace quadmap
{
/** Where a map is in another one, from the objects both have. */
struct ConstellationMatch
{
  mrpt::poses::CPose3D T_map_local;                  //!< A shift and a yaw: both are z-up
  std::vector<std::pair<ObjectId, ObjectId>> pairs;  //!< (local, map), each once
  double logOdds = 0;        //!< Of this place against all objects being there by chance
  double secondLogOdds = 0;  //!< Of the best other place; 0: none is better than chance
};

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
