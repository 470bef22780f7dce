#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace quadmap::observations
{
/** A table for other programs: rows in their order, each with its numbers by name. */
using Rows = std::vector<std::pair<std::string, std::map<std::string, double>>>;

/** {"rows": {"ROW": {"NUMBER": 1.0, ...}, ...}}, written complete or not at all.
 * \exception std::runtime_error */
void writeRows(const std::string& path, const Rows& rows);

}  // namespace quadmap::observations
