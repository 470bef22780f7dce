#include "quadmap/slam/SlamConfiguration.h"

#include <mrpt/config/CConfigFile.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"

namespace quadmap
{
std::vector<SlamConfiguration::Section> SlamConfiguration::sections()
{
  return {
      {                            "slam",           &slam},
      {                           "input",          &input},
      {                       "keyframes",      &keyframes},
      {                           "poses",          &poses},
      {                           "joint",          &joint},
      {                           "point",          &point},
      {                  "relocalization", &relocalization},
      {                          "visual",         &visual},
      {                      "perception",     &perception},
      {    "CQuadricObjectMap_insertOpts",   &mapInsertion},
      {"CQuadricObjectMap_likelihoodOpts",  &mapLikelihood},
      {    "CQuadricObjectMap_renderOpts",      &mapRender},
  };
}

SlamConfiguration SlamConfiguration::fromFile(const std::string& path)
{
  requireReadableIni(path);
  const mrpt::config::CConfigFile file(path);
  SlamConfiguration result;
  const auto known = result.sections();
  std::vector<std::string> present;
  file.getAllSections(present);
  try
  {
    for (const auto& name : present)
    {
      const auto section = std::find_if(
          known.begin(), known.end(),
          [&](const Section& s) { return mrpt::system::strCmpI(s.name, name); });
      if (section == known.end())
      {
        std::string list;
        for (const auto& s : known) list += (list.empty() ? "" : ", ") + s.name;
        throw std::invalid_argument("unknown section [" + name + "]; known: " + list);
      }
      section->options->loadFromConfigFile(file, name);
    }
  }
  catch (const std::exception& e)
  {
    throw std::invalid_argument(path + ": " + e.what());
  }
  return result;
}

mrpt::config::CConfigFileMemory SlamConfiguration::toConfig() const
{
  mrpt::config::CConfigFileMemory config;
  SlamConfiguration copy = *this;
  for (const auto& section : copy.sections())
    section.options->saveToConfigFile(config, section.name);
  return config;
}

void SlamConfiguration::visitOptions(
    const std::function<void(const std::string&, const Option&)>& each) const
{
  SlamConfiguration copy = *this;
  for (const auto& section : copy.sections())
  {
    const OptionList list = section.options->options();
    for (const auto& option : list.options()) each(section.name, option);
  }
}

std::string SlamConfiguration::documentedIni() const
{
  std::string ini =
      "; Options of quadmap-slam, each with its default: delete what you do not change. A key that "
      "is\n; misspelt is an error. `quadmap-slam --defaults` prints this file.\n";
  SlamConfiguration copy = *this;
  for (const auto& section : copy.sections())
    ini += "\n" + section.options->documentedIni(section.name);
  return ini;
}

}  // namespace quadmap
