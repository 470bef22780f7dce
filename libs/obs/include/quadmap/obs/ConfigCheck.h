#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <set>
#include <string>

namespace quadmap
{
/** Opens an INI file strictly (MRPT reads a missing file as an empty one).
 * \exception std::runtime_error If the file does not exist or cannot be read. */
void requireReadableIni(const std::string& path);

/** \exception std::invalid_argument If the section has a key that is not in `known`: a misspelt key
 * is an error, never a silent default. Keys compare without case. */
void rejectUnknownKeys(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::set<std::string>& known);

/** Reads a number strictly ("4abc" and "ten" are errors) and checks min <= value <= max.
 * A missing key leaves `value` as it is. \exception std::invalid_argument names section, key,
 * value and bounds. */
void readNumber(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::string& key,
    double& value,
    double min,
    double max);
void readNumber(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::string& key,
    int& value,
    int min,
    int max);

/** Reads true/false/yes/no/1/0 strictly. */
void readFlag(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::string& key,
    bool& value);

}  // namespace quadmap
