#pragma once

#include <vector>

#include "quadmap/constellation/SightedObject.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** The objects that were seen often enough to count, by id. Unlike the confirmed ones they include
 * those that later keyframes looked for in vain: drift makes a robot look beside what is there.
 * Pointers are to the map of `result`. */
std::vector<SightedObject> sightedObjects(const SlamResult& result);

}  // namespace quadmap
