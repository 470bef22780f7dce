#pragma once

#include <cstddef>
#include <vector>

#include "quadmap/constellation/ConstellationMatch.h"
#include "quadmap/constellation/Moves.h"

namespace quadmap
{
/** How the room differs from the known map that a run started in. Ids are those of the continued
 * map. */
struct MapContinuation
{
  std::size_t knownObjects = 0;  //!< Number of confirmed objects of the given map
  ConstellationMatch match;      //!< Here `local` means the run's own objects and frame
  /** True when the place of the run could no longer be told after the correction by the map's
   * objects. The poses are then those of the run alone, moved as a whole. */
  bool lostInCorrection = false;
  std::vector<Move> moved;
  std::vector<ObjectId> added, removed;  //!< Objects that came or went and did not move
};

}  // namespace quadmap
