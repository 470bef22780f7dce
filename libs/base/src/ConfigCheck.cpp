#include "quadmap/base/ConfigCheck.h"

#include <mrpt/core/format.h>
#include <mrpt/system/string_utils.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "quadmap/base/InputFile.h"

namespace quadmap
{
namespace
{
using mrpt::system::lowerCase;
using mrpt::system::trim;

/** The text of a key, or nothing when the key is missing. */
std::optional<std::string> textOf(
    const mrpt::config::CConfigFileBase& config, const std::string& section, const std::string& key)
{
  if (!config.keyExists(section, key)) return std::nullopt;
  return trim(config.read_string(section, key, ""));
}

[[noreturn]] void rejectValue(
    const std::string& section,
    const std::string& key,
    const std::string& value,
    const std::string& expected)
{
  throw std::invalid_argument("[" + section + "] " + key + "=" + value + ": must be " + expected);
}

bool isComment(const std::string& line)
{
  return line[0] == ';' || line[0] == '#' || line.compare(0, 2, "//") == 0;
}

/** Whether MRPT would execute something of the line, which may be a comment: loops without an end,
 * texts that double, values of the reader's environment. */
bool isProgram(const std::string& line)
{
  for (const char* mark : {"@define", "${", "$env{", "$eval{"})
    if (line.find(mark) != std::string::npos) return true;
  return false;
}

/** Checks the lines of one INI text, as far as requireReadableIni() promises. */
class IniLineCheck
{
 public:
  /** \return What is wrong with the line, empty when nothing is. */
  std::string check(const std::string& rawLine)
  {
    const std::string line = trim(rawLine);
    if (line.find('\0') != std::string::npos) return "has a zero byte, at which MRPT stops reading";
    if (isProgram(line)) return "@define, ${}, $env{} and $eval{} are not allowed";
    const bool continuation = continued_;
    continued_ = !line.empty() && line.back() == '\\';
    if (continuation || line.empty() || isComment(line)) return {};
    if (line[0] == '[') return checkSection(line);
    const auto equals = line.find('=');
    if (equals == std::string::npos || equals == 0)
      return "expected \"[section]\" or \"key = value\"";
    const std::string key = lowerCase(trim(line.substr(0, equals)));
    if (!keys_.insert(key).second) return "key \"" + key + "\" stands in its section twice";
    return {};
  }

 private:
  std::string checkSection(const std::string& line)
  {
    const auto end = line.find(']');
    if (end == std::string::npos) return "\"]\" is missing";
    keys_.clear();
    const std::string name = lowerCase(trim(line.substr(1, end - 1)));
    if (!sections_.insert(name).second) return "section [" + name + "] stands in the file twice";
    return {};
  }

  bool continued_ = false;
  std::set<std::string> sections_, keys_;
};

template <typename Number>
std::optional<Number> parsed(const std::string& text)
{
  const std::string word = trim(text);
  const char* first = word.data();
  const char* last = first + word.size();
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') ++first;
  Number value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> parseNumber(const std::string& text) { return parsed<double>(text); }

std::optional<long double> parseLongNumber(const std::string& text)
{
  return parsed<long double>(text);
}

std::optional<bool> parseFlag(const std::string& text)
{
  const std::string word = lowerCase(trim(text));
  if (word == "true" || word == "yes" || word == "1") return true;
  if (word == "false" || word == "no" || word == "0") return false;
  return std::nullopt;
}

void requirePlainIni(std::istream& text, const std::string& name)
{
  IniLineCheck lines;
  std::string line;
  for (unsigned number = 1; std::getline(text, line); ++number)
  {
    const std::string problem = lines.check(line);
    if (!problem.empty())
      throw std::runtime_error(mrpt::format("%s:%u: %s", name.c_str(), number, problem.c_str()));
  }
  if (text.bad()) throw std::runtime_error(name + ": read error");
}

void requireReadableIni(const std::string& path)
{
  auto file = openModestText(path);
  requirePlainIni(file, path);
}

void rejectUnknownKeys(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::set<std::string>& known)
{
  std::set<std::string> knownLower;
  std::string list;
  for (const auto& key : known)
  {
    knownLower.insert(lowerCase(key));
    list += (list.empty() ? "" : ", ") + key;
  }
  std::vector<std::string> keys;
  config.getAllKeys(section, keys);
  for (const auto& key : keys)
    if (knownLower.count(lowerCase(key)) == 0)
      throw std::invalid_argument("[" + section + "] unknown key \"" + key + "\"; known: " + list);
}

void rejectUnknownSections(
    const mrpt::config::CConfigFileBase& config,
    const std::string& prefix,
    const std::set<std::string>& known)
{
  std::set<std::string> knownLower;
  std::string list;
  for (const auto& name : known)
  {
    knownLower.insert(lowerCase(prefix + name));
    list += (list.empty() ? "" : ", ") + prefix + name;
  }
  std::vector<std::string> sections;
  config.getAllSections(sections);
  for (const auto& section : sections)
    if (lowerCase(section).rfind(lowerCase(prefix), 0) == 0 &&
        knownLower.count(lowerCase(section)) == 0)
      throw std::invalid_argument("unknown section [" + section + "]; known: " + list);
}

void readNumber(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::string& key,
    double& value,
    double min,
    double max)
{
  const auto text = textOf(config, section, key);
  if (!text) return;
  const auto number = parseNumber(*text);
  if (!number || !(*number >= min && *number <= max))
    rejectValue(section, key, *text, mrpt::format("a number in [%g, %g]", min, max));
  value = *number;
}

void readFlag(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::string& key,
    bool& value)
{
  const auto text = textOf(config, section, key);
  if (!text) return;
  const auto flag = parseFlag(*text);
  if (!flag) rejectValue(section, key, *text, "true or false");
  value = *flag;
}

}  // namespace quadmap
