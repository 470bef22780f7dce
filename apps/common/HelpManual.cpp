#include <cctype>

#include "HelpTable.h"

namespace quadmap::cli
{
namespace
{
/** Text as roff takes it literally. */
std::string roff(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\'' && out.empty())
      out += "\\(aq";
    else if (c == '.' && out.empty())
      out += "\\&.";
    else
      out += c;
  }
  return out;
}

std::string entryPage(const HelpEntry& entry)
{
  return ".TP\n\\fB" + roff(entry.call()) + "\\fR" + (entry.isRepeatable ? " ..." : "") + "\n" +
         roff(entry.sentences()) + "\n";
}

/** \param heading Macro of the headings: SH or SS. */
std::string argumentsPage(const HelpTable& table, const std::string& heading)
{
  std::string text;
  for (const auto& entry : table.entries)
    if (entry.isPositional) text += entryPage(entry);
  if (!text.empty()) text = "." + heading + " Arguments\n" + text;
  for (const auto& group : table.groups())
  {
    text += "." + heading + " " + roff(group) + "\n";
    for (const auto& entry : table.entries)
      if (!entry.isPositional && entry.group == group) text += entryPage(entry);
  }
  return text;
}

std::string examplesPage(const HelpTable& table)
{
  std::string text;
  for (const auto& [command, what] : table.examples)
    text += ".TP\n\\fB" + roff(command) + "\\fR\n" + roff(what) + "\n";
  return text;
}

std::string upper(std::string text)
{
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string nameAndSynopsis(const HelpTable& table, const std::string& synopsis)
{
  std::string summary = table.summary();
  if (!summary.empty())
    summary[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(summary[0])));
  return ".TH " + upper(table.program) + " 1 \"\" \"quadmap " + table.version +
         "\" \"User Commands\"\n.SH NAME\n" + table.program + " \\- " + roff(summary) +
         "\n.SH SYNOPSIS\n\\fB" + roff(synopsis) + "\\fR\n.SH DESCRIPTION\n" + roff(table.about) +
         "\n";
}
}  // namespace

std::string manualPage(const HelpTable& table)
{
  std::string text =
      nameAndSynopsis(table, table.synopsis()) + ".SH OPTIONS\n" + argumentsPage(table, "SS");
  if (!table.examples.empty()) text += ".SH EXAMPLES\n" + examplesPage(table);
  return text + manualTail();
}

std::string manualHead(const HelpTable& program, const std::vector<std::string>& commands)
{
  std::string list;
  for (const auto& command : commands) list += (list.empty() ? "" : ", ") + command;
  return nameAndSynopsis(program, program.program + " COMMAND [OPTION]... ARGUMENTS") +
         "Commands: " + roff(list) + ".\n";
}

std::string manualSection(const HelpTable& command)
{
  return ".SH \"" + upper(command.program) + "\"\n\\fB" + roff(command.synopsis()) + "\\fR\n.PP\n" +
         roff(command.about) + "\n" + argumentsPage(command, "SS") +
         (command.examples.empty() ? "" : ".SS Examples\n" + examplesPage(command));
}

std::string manualTail()
{
  return ".SH \"EXIT STATUS\"\n0: done. 1: failed, with one line on the standard error that says "
         "why. 2: wrong call.\n.SH \"SEE ALSO\"\nThe guides in the documentation of quadmap, one "
         "page for each task.\n";
}

}  // namespace quadmap::cli
