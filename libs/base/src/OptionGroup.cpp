#include "quadmap/base/OptionGroup.h"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/core/format.h>
#include <mrpt/system/string_utils.h>

#include <ostream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/OptionList.h"

namespace quadmap
{
namespace
{
using mrpt::config::CConfigFileBase;

bool startsWith(const std::string& text, const std::string& prefix)
{
  return text.compare(0, prefix.size(), prefix) == 0;
}

/** The keys that the section may have: those of the options, and those left to another reader. */
std::set<std::string> knownKeys(
    const OptionList& list, const CConfigFileBase& config, const std::string& section)
{
  std::set<std::string> known;
  for (const auto& option : list.options()) known.insert(option.key);
  std::vector<std::string> present;
  config.getAllKeys(section, present);
  for (const auto& key : present)
    for (const auto& prefix : list.foreignPrefixes())
      if (startsWith(key, prefix)) known.insert(key);
  return known;
}

void load(const Option& option, const CConfigFileBase& config, const std::string& section)
{
  if (!config.keyExists(section, option.key)) return;
  const std::string text = mrpt::system::trim(config.read_string(section, option.key, ""));
  const std::string problem = option.read(text);
  if (!problem.empty()) throw std::invalid_argument(option.key + "=" + text + ": " + problem);
}

/** Sentences as comment lines of an INI file. */
std::string commentText(const std::string& sentences)
{
  constexpr std::size_t kColumns = 100;
  std::string text, line = ";";
  std::istringstream words(sentences);
  for (std::string word; words >> word;)
  {
    if (line.size() + 1 + word.size() > kColumns)
    {
      text += line + "\n";
      line = ";";
    }
    line += " " + word;
  }
  return text + line + "\n";
}

std::string documentationOf(const Option& option)
{
  const std::string unit = option.unit.empty() ? "" : " Unit: " + option.unit + ".";
  const bool isNumber = option.bounds.min < option.bounds.max;
  return option.reason + unit + (isNumber ? " Range: " : " May be: ") + option.range + ".";
}

}  // namespace

OptionList OptionGroup::options()
{
  OptionList list;
  describe(list);
  return list;
}

OptionList OptionGroup::optionsToRead() const
{
  // Describing changes no field, and who asks here only takes texts from the list.
  return const_cast<OptionGroup*>(this)->options();
}

void OptionGroup::loadFromConfigFile(const CConfigFileBase& config, const std::string& section)
{
  const OptionList list = options();
  rejectUnknownKeys(config, section, knownKeys(list, config, section));
  std::vector<std::string> before;
  for (const auto& option : list.options()) before.push_back(option.text());
  try
  {
    for (const auto& option : list.options()) load(option, config, section);
    list.check();
  }
  catch (const std::invalid_argument& e)
  {
    for (std::size_t i = 0; i < before.size(); ++i)
      if (const Option& option = list.options()[i]; option.text() != before[i])
        option.read(before[i]);
    throw std::invalid_argument("[" + section + "] " + e.what());
  }
}

void OptionGroup::saveToConfigFile(CConfigFileBase& config, const std::string& section) const
{
  const OptionList list = optionsToRead();
  for (const auto& option : list.options()) config.write(section, option.key, option.text());
}

void OptionGroup::dumpToTextStream(std::ostream& out) const
{
  const OptionList list = optionsToRead();
  out << "----------- " << list.about() << "\n";
  for (const auto& option : list.options())
    out << mrpt::format("%-28s = %s\n", option.key.c_str(), option.text().c_str());
}

std::string OptionGroup::documentedIni(const std::string& section) const
{
  const OptionList list = optionsToRead();
  std::string ini = "[" + section + "]\n" + commentText(list.about());
  for (const auto& option : list.options())
    ini += "\n" + commentText(documentationOf(option)) + option.key + " = " + option.text() + "\n";
  return ini;
}

}  // namespace quadmap
