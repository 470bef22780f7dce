#pragma once

#include <string>
#include <vector>

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** The options of one section of an INI file. */
struct IniSection
{
  std::string name;
  OptionGroup* options;
};

/** Reads the sections that a file has. All other options keep their values.
 * \exception std::runtime_error If the file cannot be read.
 * \exception std::invalid_argument For unknown sections and keys and for bad values; the message
 * starts with the file's name. */
void readIniSections(const std::string& path, const std::vector<IniSection>& known);

/** All options with their values, units, ranges and what they do, as the text of a file. */
std::string documentedIni(const std::vector<IniSection>& sections);

}  // namespace quadmap
