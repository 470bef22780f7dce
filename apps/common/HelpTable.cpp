#include "HelpTable.h"

#include <algorithm>
#include <sstream>

namespace quadmap::cli
{
namespace
{
/** What is between the first "<" and the last ">" of "[-o <FILE>]". */
std::string labelOf(const TCLAP::Arg& arg)
{
  const std::string id = arg.shortID();
  const auto from = id.find('<'), to = id.rfind('>');
  return from == std::string::npos || to <= from ? "" : id.substr(from + 1, to - from - 1);
}

/** The value that an argument has before the command line is parsed. Zero stands for "none". */
std::string presetOf(TCLAP::Arg& arg)
{
  std::ostringstream text;
  if (auto* value = dynamic_cast<TCLAP::ValueArg<std::string>*>(&arg)) text << value->getValue();
  const auto number = [&](auto value)
  {
    if (value != 0) text << value;
  };
  if (auto* value = dynamic_cast<TCLAP::ValueArg<double>*>(&arg)) number(value->getValue());
  if (auto* value = dynamic_cast<TCLAP::ValueArg<int>*>(&arg)) number(value->getValue());
  return text.str();
}

bool isPositional(const TCLAP::Arg& arg)
{
  return arg.shortID().find("-" + arg.getName()) == std::string::npos && arg.getFlag().empty();
}

HelpEntry entryOf(TCLAP::Arg& arg)
{
  HelpEntry entry;
  entry.flag = arg.getFlag();
  entry.name = arg.getName();
  entry.label = labelOf(arg);
  entry.what = arg.getDescription();
  const std::string prefix = "(required)  ";  // TCLAP's own
  if (entry.what.rfind(prefix, 0) == 0) entry.what = entry.what.substr(prefix.size());
  if (entry.flag == "-") entry.what = "What follows is no option, whatever it begins with.";
  entry.isRequired = arg.isRequired();
  entry.isRepeatable = arg.acceptsMultipleValues();
  entry.isPositional = isPositional(arg);
  if (!entry.isRequired) entry.preset = presetOf(arg);
  return entry;
}
}  // namespace

std::string HelpEntry::call() const
{
  if (isPositional) return label;
  std::string text = flag.empty() || flag == "-" ? "" : "-" + flag;
  if (flag != "-") text += (text.empty() ? "--" : ", --") + name;
  if (flag == "-") text = "--";
  return label.empty() ? text : text + " " + label;
}

std::vector<std::string> HelpEntry::choices() const
{
  std::vector<std::string> words;
  if (label.find('|') == std::string::npos) return words;
  std::istringstream text(label);
  for (std::string word; std::getline(text, word, '|');)
    if (std::none_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c); }))
      words.push_back(word);
  return words;
}

bool HelpEntry::takesPath() const
{
  const auto has = [&](const char* word) { return label.find(word) != std::string::npos; };
  return has("FILE") || has("DIR") || has("MAP") || has(".");
}

std::string HelpEntry::sentences() const
{
  if (preset.empty() || what.find("default") != std::string::npos) return what;
  return what + " Default: " + preset + ".";
}

std::string HelpTable::summary() const
{
  std::size_t end = about.size() - (!about.empty() && about.back() == '.');
  for (const char* mark : {". ", ": "}) end = std::min(end, about.find(mark));
  return about.substr(0, end);
}

std::vector<std::string> HelpTable::groups() const
{
  std::vector<std::string> names;
  for (const auto& entry : entries)
    if (!entry.isPositional && std::find(names.begin(), names.end(), entry.group) == names.end())
      names.push_back(entry.group);
  const auto general = std::find(names.begin(), names.end(), kGeneralGroup);
  if (general != names.end()) std::rotate(general, general + 1, names.end());
  return names;
}

std::string HelpTable::synopsis() const
{
  std::string text = program;
  for (const auto& entry : entries)
    if (!entry.isPositional && entry.isRequired)
      text += " " + entry.call().substr(entry.call().find("--"));
  text += " [OPTION]...";
  for (const auto& entry : entries)
    if (entry.isPositional)
      text += " " + (entry.isRequired ? entry.label : "[" + entry.label + "]");
  return text;
}

std::size_t namedArguments(TCLAP::CmdLine& line)
{
  const auto& list = line.getArgList();
  return static_cast<std::size_t>(
      std::count_if(list.begin(), list.end(), [](const auto* arg) { return !isPositional(*arg); }));
}

std::vector<HelpEntry> helpEntriesOf(
    TCLAP::CmdLine& line, const std::vector<std::pair<std::size_t, std::string>>& groups)
{
  std::vector<HelpEntry> named, positional;
  for (TCLAP::Arg* arg : line.getArgList())
    (isPositional(*arg) ? positional : named).push_back(entryOf(*arg));
  std::reverse(named.begin(), named.end());  // TCLAP puts the latest first
  for (std::size_t i = 0; i < named.size(); ++i)
    for (const auto& [first, name] : groups)
      if (first <= i) named[i].group = name;
  named.insert(named.end(), positional.begin(), positional.end());
  return named;
}

}  // namespace quadmap::cli
