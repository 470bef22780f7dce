#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/slam/relocalization/ConstellationMatch.h"

namespace quadmap
{
class BackEnd;
struct SlamResult;

/** What a run found changed in the map it started in. Ids are those of the continued map. */
struct MapContinuation
{
  struct Move
  {
    ObjectId from = 0, to = 0;  //!< The one that is gone, and the one that came
    double distance = 0;        //!< Between their centres [m]
  };
  std::size_t knownObjects = 0;  //!< Confirmed ones of the given map
  ConstellationMatch match;      //!< `local`: the run's own objects and frame
  /** Corrected by the map's objects it could no longer be told where the run was: its poses are
   * those of the run, moved as a whole */
  bool lostInCorrection = false;
  std::vector<Move> moved;
  std::vector<ObjectId> added, removed;  //!< Those that did not move
};

/** The run's objects are not, or not only in one place, in the map. */
struct NotLocalised : std::runtime_error
{
  using runtime_error::runtime_error;
};

/** Finds a finished run in a map and carries that on: the poses go into the map's frame and are
 * corrected by its objects, what is gone is taken out, and the run's observations are put in. Ids
 * of known objects stay.
 * \param backEnd That of the run. \param boxesOf As in BackEnd.
 * \param result Of the whole run, in its own frame.
 * \exception NotLocalised `result` is then unchanged. */
void continueMap(
    const CQuadricObjectMap& given,
    BackEnd& backEnd,
    const std::function<CObservationObjects::Ptr(std::size_t)>& boxesOf,
    const RelocalizationOptions& options,
    SlamResult& result);

}  // namespace quadmap
