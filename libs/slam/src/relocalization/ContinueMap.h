#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>

#include "backend/BackEnd.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/slam/RelocalizationOptions.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
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
