#pragma once

#include <mrpt/3rdparty/tclap/CmdLine.h>

#include <string>
#include <utility>
#include <vector>

namespace quadmap::cli
{
/** One argument as a reader sees it. */
struct HelpEntry
{
  std::string flag, name;  //!< "o" and "output"; the flag may be empty
  std::string label;       //!< Of the value, "FILE" or "a|b"; empty for a switch
  std::string what;        //!< Whole sentences
  std::string group;       //!< Heading below which it stands
  std::string preset;      //!< Value without the argument; empty: none that means something
  bool isRequired = false, isRepeatable = false;
  bool isPositional = false;  //!< Is told by its place; its name is then no part of the call

  /** "-o, --output FILE". */
  std::string call() const;
  /** The words of "a|b|graph:FILE" that are typed as they stand: a and b. */
  std::vector<std::string> choices() const;
  /** Whether the value may be the path of a file or folder: "FILE", "OUTDIR|MAP", "OUT.json". */
  bool takesPath() const;
  /** The description, with the preset when it does not speak of it. */
  std::string sentences() const;
};

/** What --help, the manual page and the completion of a program or a command are made of. */
struct HelpTable
{
  std::string program;  //!< "quadmap-export", "quadmap-map query"
  std::string about;    //!< Whole sentences; the first one alone is its summary
  std::string version;
  std::vector<HelpEntry> entries;                             //!< In the order of their declaration
  std::vector<std::pair<std::string, std::string>> examples;  //!< Command, and what it does

  std::string summary() const;              //!< First sentence, without its dot
  std::vector<std::string> groups() const;  //!< Headings of the options in their order
  std::string synopsis() const;             //!< "quadmap-export [OPTION]... OUTDIR"
};

/** Heading of the arguments that every program has. */
inline const char* const kGeneralGroup = "General";

/** The arguments of a command line that was not parsed yet, so that all values are presets.
 * \param groups Headings with the number of named arguments that are declared before each. */
std::vector<HelpEntry> helpEntriesOf(
    TCLAP::CmdLine& line, const std::vector<std::pair<std::size_t, std::string>>& groups);

/** Number of the arguments that have names so far. */
std::size_t namedArguments(TCLAP::CmdLine& line);

/** Text for a terminal. */
std::string helpText(const HelpTable& table);

/** Manual page in the macros of man(7), and that of a program with commands, whose sections stand
 * between head and tail. */
std::string manualPage(const HelpTable& table);
std::string manualHead(const HelpTable& program, const std::vector<std::string>& commands);
std::string manualSection(const HelpTable& command);
std::string manualTail();

/** Completion for bash, and that of a program with commands, whose sections stand in between. */
std::string completion(const HelpTable& table);
std::string completionHead(const std::string& program, const std::vector<std::string>& commands);
std::string completionSection(const HelpTable& command, const std::string& name);
std::string completionTail(const std::string& program, bool afterCommands = false);

}  // namespace quadmap::cli
