#include "scene/SceneText.h"

#include <mrpt/core/format.h>
#include <mrpt/system/string_utils.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"

namespace quadmap::simulator
{
std::vector<std::string> wordsOf(const std::string& text)
{
  std::vector<std::string> words;
  mrpt::system::tokenize(text, " \t,", words);
  return words;
}

void Entry::reject(const std::string& why) const
{
  throw std::invalid_argument("[" + section + "] " + key + "=" + text + ": " + why);
}

double Entry::number(const std::string& word, double min, double max) const
{
  const auto value = parseNumber(word);
  if (!value || !(*value >= min && *value <= max))
    reject(mrpt::format("\"%s\" must be a number in [%g, %g]", word.c_str(), min, max));
  return *value;
}

Eigen::Vector3d Entry::vector(
    const std::vector<std::string>& words, std::size_t first, double min, double max) const
{
  return {
      number(words[first], min, max), number(words[first + 1], min, max),
      number(words[first + 2], min, max)};
}

Eigen::Vector3d Entry::vector(double min, double max) const
{
  const auto words = wordsOf(text);
  if (words.size() != 3) reject("expected three numbers");
  return vector(words, 0, min, max);
}

std::optional<Entry> entryOf(
    const mrpt::config::CConfigFileBase& config, const std::string& section, const std::string& key)
{
  if (!config.keyExists(section, key)) return std::nullopt;
  return Entry{section, key, mrpt::system::trim(config.read_string(section, key, ""))};
}

std::vector<Entry> numberedEntries(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::string& prefix)
{
  std::map<double, Entry> ordered;
  std::vector<std::string> keys;
  config.getAllKeys(section, keys);
  for (const auto& key : keys)
  {
    if (key.compare(0, prefix.size(), prefix) != 0) continue;
    const Entry e = *entryOf(config, section, key);
    const auto number = parseNumber(key.substr(prefix.size()));
    if (!number || !(*number >= 0 && *number < 1e6) || *number != std::floor(*number))
      e.reject("the key must be " + prefix + "NUMBER");
    if (!ordered.emplace(*number, e).second) e.reject("there is another one with this number");
  }
  std::vector<Entry> entries;
  for (const auto& item : ordered) entries.push_back(item.second);
  return entries;
}

}  // namespace quadmap::simulator
