#pragma once

#include <Eigen/Dense>
#include <deque>
#include <map>
#include <vector>

#include "quadmap/graph/FactorGraph.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** The latest places from which each object was seen. */
using CamerasOf = std::map<ObjectId, std::deque<Eigen::Vector3d>>;

/** Gives the views of the objects that the map merged with its last observation to the objects that
 * have their measurements now. */
void followMerged(const CQuadricObjectMap& map, FactorGraph& graph, CamerasOf& cameras);

/** Gives them the boxes that were decided for the merged ones as well. */
void followMerged(const CQuadricObjectMap& map, std::vector<BoxDecision>& decisions);

/** For each object of one map of a run the object of another one that has most of its boxes.
 * \param before,after The decisions that led to the maps. */
std::map<ObjectId, ObjectId> heirsOf(
    const std::vector<BoxDecision>& before, const std::vector<BoxDecision>& after);

}  // namespace quadmap
