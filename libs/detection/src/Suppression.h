#pragma once

#include <vector>

#include "heads/Head.h"

namespace quadmap
{
/** Sorts boxes by score, the surest first, and removes those that overlap a surer one of their
 * label by more than `maxOverlap` (intersection over union). Equal scores keep their order. \param
 * most Largest number of boxes that stay. */
std::vector<RawBox> suppressOverlaps(
    std::vector<RawBox> rawBoxes, double maxOverlap, std::size_t most);

}  // namespace quadmap
