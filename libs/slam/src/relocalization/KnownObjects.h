#pragma once

#include <map>
#include <utility>
#include <vector>

#include "quadmap/graph/GraphFactors.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/slam/RelocalizationOptions.h"

namespace quadmap
{
/** What a map knows of one object that a run has found again, its axes named as the run has them.
 * \param sigma What each side may err by beyond the map's covariance [m], > 0. */
ObjectPrior priorOf(const MapObject& local, const MapObject& given, double sigma);

/** Priors of the objects that a run has found again, by their ids in the run: the map's state, and
 * its covariance enlarged by (19.7).
 * \param pairs (local, given), of objects the maps have. */
std::map<ObjectId, ObjectPrior> priorsOf(
    const CQuadricObjectMap& local,
    const CQuadricObjectMap& given,
    const std::vector<std::pair<ObjectId, ObjectId>>& pairs,
    const RelocalizationOptions& options);

}  // namespace quadmap
