#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <iosfwd>
#include <optional>
#include <set>
#include <string>

namespace quadmap
{
/** The number a text consists of, blanks around it aside; nothing for "4abc", "ten" and "". The
 * locale plays no part. "nan" and "inf" are numbers: check the bounds. */
std::optional<double> parseNumber(const std::string& text);

/** The same with the digits of a long double: degrees must become exact radians. */
std::optional<long double> parseLongNumber(const std::string& text);

/** True for true, yes and 1, false for false, no and 0, nothing for other texts. */
std::optional<bool> parseFlag(const std::string& text);

/** Checks an INI text before MRPT reads it, which drops lines it does not understand, lets the last
 * of two equal keys win, and executes \@define, ${}, $env{} and $eval{}.
 * \param name For messages.
 * \exception std::runtime_error For a line that is neither `[section]`, `key = value` nor a
 * comment, for one that MRPT would execute, and for a section or key that stands there twice; names
 * the line. */
void requirePlainIni(std::istream& text, const std::string& name);

/** Does so with a file, of which MRPT reads a missing one as an empty one.
 * \exception std::runtime_error As requirePlainIni(), and if the file cannot be read. */
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

/** Reads true/false/yes/no/1/0 strictly. */
void readFlag(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::string& key,
    bool& value);

/** \exception std::invalid_argument If a section whose name starts with `prefix` goes on otherwise
 *  than one of `known`: misspelt, it would be ignored. Case plays no part. */
void rejectUnknownSections(
    const mrpt::config::CConfigFileBase& config,
    const std::string& prefix,
    const std::set<std::string>& known);

}  // namespace quadmap
