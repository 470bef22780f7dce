#pragma once

#include <map>
#include <string>
#include <vector>

#include "CommandLine.h"

namespace quadmap::cli
{
/** What a program with commands ("quadmap-map info") does for each; gets what follows the program's
 * name. */
using Subcommands = std::map<std::string, void (*)(int, char**)>;

/** Manual page or completion of a program with commands, each of which adds its section. */
inline void printHelpAs(
    const std::string& form, const HelpTable& program, const Subcommands& commands)
{
  const bool isManual = form == "man";
  if (!isManual && form != "completion")
    throw UsageError("--help-as " + form + ": must be man or completion");
  std::vector<std::string> names;
  for (const auto& known : commands) names.push_back(known.first);
  std::cout << (isManual ? manualHead(program, names) : completionHead(program.program, names));
  for (const auto& [name, run] : commands)
  {
    std::string words[3] = {name, "--help-as", form + "-section"};
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    run(3, arguments);
  }
  std::cout << (isManual ? manualTail() : completionTail(program.program, true));
}

/** Runs a command. \exception UsageError Names it. */
inline void runSubcommand(const Subcommands::value_type& command, int argc, char** argv)
{
  try
  {
    command.second(argc, argv);
  }
  catch (const UsageError& e)
  {
    throw UsageError(e.what(), command.first);
  }
}

/** main() of such a program.
 * \param description Of the program, for --help without a command. */
inline int runSubcommands(
    const std::string& program,
    const std::string& description,
    const Subcommands& commands,
    int argc,
    char** argv)
{
  return runMain(
      program.c_str(),
      [&]
      {
        const auto command = argc > 1 ? commands.find(argv[1]) : commands.end();
        if (command != commands.end()) return runSubcommand(*command, argc - 1, argv + 1);
        if (argc == 3 && argv[1] == std::string("--help-as"))
          return printHelpAs(argv[2], {program, description, QUADMAP_VERSION, {}, {}}, commands);
        // --help, --version, and what is wrong when no command is given.
        std::vector<std::string> names;
        for (const auto& known : commands) names.push_back(known.first);
        TCLAP::ValuesConstraint<std::string> known(names);
        CommandLine line(
            program,
            description + " Each command has its own --help: " + program + " " + names.front() +
                " --help.",
            QUADMAP_VERSION);
        TCLAP::UnlabeledValueArg<std::string> name(
            "COMMAND", "What to do.", true, "", &known, line.args());
        line.parse(argc, argv);
      });
}

}  // namespace quadmap::cli
