#include "quadmap/slam/SlamConfiguration.h"

namespace quadmap
{
std::vector<IniSection> SlamConfiguration::sections()
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
  SlamConfiguration result;
  readIniSections(path, result.sections());
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
  return ini + quadmap::documentedIni(copy.sections());
}

}  // namespace quadmap
