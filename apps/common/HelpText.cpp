#include <sstream>

#include "HelpTable.h"

namespace quadmap::cli
{
namespace
{
constexpr std::size_t kColumns = 80, kIndent = 6;

/** Words in lines of at most kColumns, each behind so many blanks. */
std::string wrapped(const std::string& sentences, std::size_t indent)
{
  const std::string blanks(indent, ' ');
  std::string text, line;
  std::istringstream words(sentences);
  for (std::string word; words >> word;)
  {
    if (!line.empty() && indent + line.size() + 1 + word.size() > kColumns)
    {
      text += blanks + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + blanks + line + "\n";
}

std::string entryText(const HelpEntry& entry)
{
  std::string call = "  " + entry.call();
  if (entry.isRepeatable && !entry.isPositional) call += " ...";
  return call + "\n" + wrapped(entry.sentences(), kIndent);
}
}  // namespace

std::string helpText(const HelpTable& table)
{
  std::string text = wrapped("Usage: " + table.synopsis(), 0) + "\n" + wrapped(table.about, 0);
  std::string positional;
  for (const auto& entry : table.entries)
    if (entry.isPositional) positional += entryText(entry);
  if (!positional.empty()) text += "\nArguments:\n" + positional;
  for (const auto& group : table.groups())
  {
    text += "\n" + group + ":\n";
    for (const auto& entry : table.entries)
      if (!entry.isPositional && entry.group == group) text += entryText(entry);
  }
  if (!table.examples.empty()) text += "\nExamples:\n";
  for (const auto& [command, what] : table.examples)
    text += "  " + command + "\n" + wrapped(what, kIndent);
  return text;
}

}  // namespace quadmap::cli
