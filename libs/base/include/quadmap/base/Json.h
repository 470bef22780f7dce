#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace quadmap
{
/** Keys keep the order of insertion, so that files can be reproduced. */
using Json = nlohmann::ordered_json;

/** Reads a JSON file. \exception std::runtime_error If it cannot be read or is no JSON; the message
 *  starts with the path and names line and column. */
Json readJson(const std::string& path);

/** A whole number that 64 bits hold, also when it is written as 3.0 or 3e2; nothing for other
 * numbers and for what is no number. The library's own conversion cuts fractions off, and is not
 * defined for 1e300. */
std::optional<std::int64_t> wholeNumber(const Json& value);

/** One line, or lines with an indent. Labels and file names may hold any bytes: what is not UTF-8
 *  is replaced. \param indent Columns per level; -1: one line. */
std::string jsonText(const Json& json, int indent = -1);

/** A number with so many decimals, never a negative zero; null when it is not finite. */
Json rounded(double value, int decimals);

/** Null when there is no number. */
Json orNull(const std::optional<double>& value);

}  // namespace quadmap
