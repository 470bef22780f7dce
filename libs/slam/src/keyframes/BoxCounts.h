#pragma once

#include <map>
#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Counts the kinds of measurement that the boxes became, by canonical label. */
void countBoxes(
    const CObservationObjects& boxes,
    const LabelTable& labels,
    std::map<std::string, LabelCounts>& counts);

/** The lines of a table with the kinds of measurement that the boxes of each label became. */
std::vector<std::string> modelShares(const std::map<std::string, LabelCounts>& labels);

}  // namespace quadmap
