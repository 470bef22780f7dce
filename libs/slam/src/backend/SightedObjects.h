#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** An object of a run's map with the keyframes that saw it. */
struct SightedObject
{
  const MapObject* object = nullptr;
  std::set<std::size_t> keyframes;
  std::size_t nearest = 0;  //!< The keyframe that saw it from nearest: it says most of its place
};

/** The objects that were seen often enough to count, by id. Unlike the confirmed ones they include
 * those that later keyframes looked for in vain: drift makes a robot look beside what is there.
 * Pointers are to the map of `result`. */
std::vector<SightedObject> sightedObjects(const SlamResult& result);

/** Did images show both? They are two things then. Few of the images that showed one of them do not
 * count: there a box may have been given to the wrong one. */
bool wereSeenTogether(const SightedObject& a, const SightedObject& b);

}  // namespace quadmap
