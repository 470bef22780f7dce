#pragma once

#include <vector>

#include "quadmap/constellation/ConstellationOptions.h"
#include "quadmap/estimation/MapObject.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** A thing that went from one place to another. */
struct Move
{
  ObjectId from = 0, to = 0;  //!< The object that is gone, and the one that came
  double distance = 0;        //!< Distance between their centres [m]
};

/** Pairs what is gone with what came, each once. The pairs are alike, and the sum of their ways is
 * the shortest.
 * \param gone,came In one frame. \return In the order of `gone`. */
std::vector<Move> movesBetween(
    const std::vector<const MapObject*>& gone,
    const std::vector<const MapObject*>& came,
    const LabelTable& labels,
    const ConstellationOptions& options);

}  // namespace quadmap
