#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "quadmap/estimation/MapObject.h"

namespace quadmap
{
/** Where a run is in a known map, from the objects that both have. */
struct ConstellationMatch
{
  mrpt::poses::CPose3D T_map_local;                  //!< A shift and a yaw, as both frames are z-up
  std::vector<std::pair<ObjectId, ObjectId>> pairs;  //!< (local, map), each once
  double logOdds = 0;                                //!< For this place, against chance
  double secondLogOdds = 0;  //!< The same of the best other place; 0 if chance is better
};

/** How the room differs from the known map that a run started in. Ids are those of the continued
 * map. */
struct MapContinuation
{
  struct Move
  {
    ObjectId from = 0, to = 0;  //!< The object that is gone, and the one that came
    double distance = 0;        //!< Distance between their centres [m]
  };
  std::size_t knownObjects = 0;  //!< Number of confirmed objects of the given map
  ConstellationMatch match;      //!< Here `local` means the run's own objects and frame
  /** True when the place of the run could no longer be told after the correction by the map's
   * objects. The poses are then those of the run alone, moved as a whole. */
  bool lostInCorrection = false;
  std::vector<Move> moved;
  std::vector<ObjectId> added, removed;  //!< Objects that came or went and did not move
};

}  // namespace quadmap
