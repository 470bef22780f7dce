#include "quadmap/base/IniSections.h"

#include <mrpt/config/CConfigFile.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"

namespace quadmap
{
namespace
{
std::string namesOf(const std::vector<IniSection>& sections)
{
  std::string list;
  for (const auto& s : sections) list += (list.empty() ? "" : ", ") + s.name;
  return list;
}

}  // namespace

void readIniSections(const std::string& path, const std::vector<IniSection>& known)
{
  requireReadableIni(path);
  const mrpt::config::CConfigFile file(path);
  std::vector<std::string> present;
  file.getAllSections(present);
  try
  {
    for (const auto& name : present)
    {
      const auto section = std::find_if(
          known.begin(), known.end(),
          [&](const IniSection& s) { return mrpt::system::strCmpI(s.name, name); });
      if (section == known.end())
        throw std::invalid_argument("unknown section [" + name + "]; known: " + namesOf(known));
      section->options->loadFromConfigFile(file, name);
    }
  }
  catch (const std::exception& e)
  {
    throw std::invalid_argument(path + ": " + e.what());
  }
}

std::string documentedIni(const std::vector<IniSection>& sections)
{
  std::string ini;
  for (const auto& section : sections) ini += "\n" + section.options->documentedIni(section.name);
  return ini;
}

}  // namespace quadmap
