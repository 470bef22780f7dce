#pragma once

#include <string>
#include <vector>

#include "quadmap/base/Json.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/review/ReportPage.h"

namespace quadmap
{
// The parts of a report as HTML. What report.json lacks, as that of an older version, is "-".

std::string runSection(const Json& report);          //!< What was read and what came of it
std::string truthSection(const ReportTruth& truth);  //!< The figures of the comparison
std::string warningSection(const Json& report);      //!< Warnings, and what was left out
std::string boxSection(const Json& report);          //!< Kinds and reasons of the boxes, per label
std::string objectSection(const std::vector<ObjectRecord>& objects);
std::string timeSection(const Json& report);  //!< CPU time per module

}  // namespace quadmap
