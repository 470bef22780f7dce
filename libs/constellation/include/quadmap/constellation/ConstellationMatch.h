#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <utility>
#include <vector>

#include "quadmap/constellation/ConstellationOptions.h"
#include "quadmap/estimation/MapObject.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Where a run or a map (local) is in a map, from the objects that both have. */
struct ConstellationMatch
{
  mrpt::poses::CPose3D T_map_local;                  //!< A shift and a yaw, as both frames are z-up
  std::vector<std::pair<ObjectId, ObjectId>> pairs;  //!< (local, map), each once
  double logOdds = 0;                                //!< For this place, against chance
  double secondLogOdds = 0;  //!< The same of the best other place; 0 if chance is better
};

/** Are two objects so alike that they can be one, wherever they are? Labels and sizes; which of the
 * horizontal axes is x plays no part. */
bool areAlike(
    const MapObject& a,
    const MapObject& b,
    const LabelTable& labels,
    const ConstellationOptions& options);

/** Finds the constellation of `local` in `map` (doc/mathematics.md, "Where in a known map").
 * Nothing when too few objects are found again, or when they could as well be elsewhere: a
 * symmetric room. Deterministic; the order of the objects plays no part beyond ties. */
std::optional<ConstellationMatch> matchConstellation(
    const std::vector<const MapObject*>& local,
    const std::vector<const MapObject*>& map,
    const LabelTable& labels,
    const ConstellationOptions& options);

}  // namespace quadmap
