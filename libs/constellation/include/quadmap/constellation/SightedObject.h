#pragma once

#include <cstddef>
#include <set>

#include "quadmap/estimation/MapObject.h"

namespace quadmap
{
/** An object of a run's map with the keyframes that saw it. */
struct SightedObject
{
  const MapObject* object = nullptr;
  std::set<std::size_t> keyframes;
  std::size_t nearest = 0;  //!< The keyframe that saw it from nearest: it says most of its place
};

/** Did images show both? They are two things then. Few of the images that showed one of them do not
 * count: there a box may have been given to the wrong one. */
bool wereSeenTogether(const SightedObject& a, const SightedObject& b);

}  // namespace quadmap
