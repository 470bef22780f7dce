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
        if (command != commands.end()) return command->second(argc - 1, argv + 1);
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
