#pragma once

#include <functional>

#include "cloud/BoxCandidates.h"

namespace quadmap
{
/** Fills the mask of an object of which every step-th cell of every step-th row is known, and of
 * all cells along its rim, where one more or less decides how large it is; every step-th of these
 * becomes a cell of the object, too.
 * \param gap Candidates no farther in depth from a known cell beside them belong to it [m].
 * \param isFree False for cells that belong to other objects. */
void addRim(
    const BoxCandidates& candidates,
    double gap,
    const std::function<bool(const ObjectCloud::Cell&)>& isFree,
    ObjectCloud& object);

}  // namespace quadmap
