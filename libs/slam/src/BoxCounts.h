#pragma once

#include <map>
#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Adds what became of the measured boxes, by canonical label. */
void countBoxes(
    const CObservationObjects& boxes,
    const LabelTable& labels,
    std::map<std::string, LabelCounts>& counts);

/** A table of which model the boxes of each label became, a line each. */
std::vector<std::string> modelShares(const std::map<std::string, LabelCounts>& labels);

}  // namespace quadmap
