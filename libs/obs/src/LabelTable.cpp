#include "quadmap/obs/LabelTable.h"

#include <mrpt/config/CConfigFile.h>
#include <mrpt/core/format.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "LabelCounts.h"
#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/ShareFiles.h"

namespace quadmap
{
namespace
{
using mrpt::config::CConfigFile;

/** The letters and digits of a label in lower case, which all its spellings have in common. */
std::string keyOf(const std::string& label)
{
  std::string key;
  for (const char c : label)
    if (c != ' ' && c != '\t' && c != '_' && c != '-')
      key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return key;
}

std::string withoutInstanceNumber(std::string key)
{
  while (!key.empty() && std::isdigit(static_cast<unsigned char>(key.back()))) key.pop_back();
  return key;
}

/** Reads a list: "a, b c, d" is {"a", "b c", "d"}. */
std::vector<std::string> readList(
    const CConfigFile& config, const std::string& section, const std::string& key)
{
  std::vector<std::string> parts, list;
  mrpt::system::tokenize(config.read_string(section, key, ""), ",", parts);
  for (const auto& part : parts)
    if (const auto word = mrpt::system::trim(part); !word.empty()) list.push_back(word);
  return list;
}

UsualSupport readSupport(const CConfigFile& config, const std::string& section)
{
  const auto word = mrpt::system::lowerCase(config.read_string(section, "support", "any"));
  if (word == "floor") return UsualSupport::Floor;
  if (word == "object") return UsualSupport::Object;
  if (word == "wall") return UsualSupport::Wall;
  if (word == "any") return UsualSupport::Any;
  throw std::invalid_argument(
      "[" + section + "] support=" + word + ": must be floor, object, wall or any");
}

Eigen::Vector3d readSize(const CConfigFile& config, const std::string& section)
{
  const auto text = config.read_string(section, "typicalSize", "");
  std::vector<std::string> words;
  mrpt::system::tokenize(text, " \t,", words);
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < words.size() && i < 3; ++i)
    size[static_cast<int>(i)] = parseNumber(words[i]).value_or(0.0);
  if (words.size() != 3 || !size.allFinite() || size.minCoeff() < LabelLimits::kSmallestSize ||
      size.maxCoeff() > LabelLimits::kLargestSize)
    throw std::invalid_argument(
        "[" + section + "] typicalSize=" + text + ": must be three lengths in [0.01, 100] m");
  return size;
}

LabelProperties readProperties(const CConfigFile& config, const std::string& section)
{
  rejectUnknownKeys(
      config, section,
      {"aliases", "shapeExponent", "dominantDirection", "levelTop", "support", "typicalSize",
       "sizeSpread", "confusedWith"});
  LabelProperties p;
  p.name = section;
  p.known = true;
  readNumber(config, section, "shapeExponent", p.shapeExponent, 1.0, 2.0);
  readFlag(config, section, "dominantDirection", p.dominantDirection);
  readFlag(config, section, "levelTop", p.levelTop);
  p.support = readSupport(config, section);
  p.typicalSize = readSize(config, section);
  readNumber(
      config, section, "sizeSpread", p.sizeSpread, LabelLimits::kSmallestSpread,
      LabelLimits::kLargestSpread);
  p.confusedWith = readList(config, section, "confusedWith");
  if (p.confusedWith.size() > kMaxConfused)
    throw std::invalid_argument(
        "[" + section + mrpt::format("] confusedWith: more than %u labels", kMaxConfused));
  return p;
}

bool lists(const LabelProperties& p, const std::string& other)
{
  return std::find(p.confusedWith.begin(), p.confusedWith.end(), other) != p.confusedWith.end();
}

}  // namespace

LabelTable LabelTable::fromFile(const std::string& path)
{
  requireReadableIni(path);
  try
  {
    const CConfigFile config(path);
    return LabelTable(config);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(path + ": " + e.what());
  }
}

LabelTable::LabelTable(const CConfigFile& config)
{
  std::vector<std::string> sections;
  config.getAllSections(sections);
  for (const auto& section : sections)
  {
    byName_[section] = readProperties(config, section);
    addSpelling(section, section);
    for (const auto& alias : readList(config, section, "aliases")) addSpelling(alias, section);
  }
  if (byName_.empty()) throw std::runtime_error("no label in it: expected one [section] per class");
  if (byName_.size() > kMaxClasses || canonicalByKey_.size() > kMaxSpellings)
    throw std::invalid_argument(
        mrpt::format("more than %u labels, or %u spellings of them", kMaxClasses, kMaxSpellings));
  for (auto& [name, properties] : byName_)
    for (auto& other : properties.confusedWith)
    {
      const auto found = canonicalByKey_.find(keyOf(other));
      if (found == canonicalByKey_.end())
        throw std::invalid_argument("[" + name + "] confusedWith: no label \"" + other + "\"");
      other = found->second;
    }
}

void LabelTable::addSpelling(const std::string& spelling, const std::string& name)
{
  const auto key = keyOf(spelling);
  if (spelling.size() > kLongestLabel)
    throw std::invalid_argument(
        mrpt::format("[%.40s] a label of more than %zu bytes", name.c_str(), kLongestLabel));
  if (key.empty()) throw std::invalid_argument("[" + name + "] a label without letters");
  const auto [at, isNew] = canonicalByKey_.emplace(key, name);
  if (!isNew && at->second != name)
    throw std::invalid_argument(
        "[" + name + "] spelling \"" + spelling + "\" already belongs to [" + at->second + "]");
}

LabelTable LabelTable::installed() { return fromFile(findShareFile("labels.ini")); }

std::string LabelTable::canonical(const std::string& label) const
{
  const auto key = keyOf(label);
  auto found = canonicalByKey_.find(key);
  if (found == canonicalByKey_.end()) found = canonicalByKey_.find(withoutInstanceNumber(key));
  return found == canonicalByKey_.end() ? label : found->second;
}

LabelProperties LabelTable::properties(const std::string& label) const
{
  const auto found = byName_.find(canonical(label));
  if (found != byName_.end()) return found->second;
  LabelProperties neutral;
  neutral.name = label;
  return neutral;
}

LabelTable LabelTable::completedBy(const LabelTable& other) const
{
  LabelTable both = *this;
  both.byName_.insert(other.byName_.begin(), other.byName_.end());
  both.canonicalByKey_.insert(other.canonicalByKey_.begin(), other.canonicalByKey_.end());
  return both;
}

bool LabelTable::compatible(const std::string& a, const std::string& b) const
{
  const auto nameA = canonical(a), nameB = canonical(b);
  if (keyOf(nameA) == keyOf(nameB)) return true;
  const auto foundA = byName_.find(nameA), foundB = byName_.find(nameB);
  return (foundA != byName_.end() && lists(foundA->second, nameB)) ||
         (foundB != byName_.end() && lists(foundB->second, nameA));
}

}  // namespace quadmap
