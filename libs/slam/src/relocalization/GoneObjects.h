#pragma once

#include <set>

#include "backend/BackEnd.h"
#include "quadmap/slam/RelocalizationOptions.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Confirmed objects of a map that a run shows to be no longer where they were.
 * \param run Its keyframes are in the map's frame; its objects are those of its own frame.
 * \param match Where they are in the map. */
std::set<ObjectId> goneObjects(
    const CQuadricObjectMap& given,
    const SlamResult& run,
    const ConstellationMatch& match,
    const BackEnd::BoxesOf& boxesOf,
    const RelocalizationOptions& options);

}  // namespace quadmap
