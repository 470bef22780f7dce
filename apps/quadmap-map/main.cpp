#include <map>
#include <string>

#include "Commands.h"
#include "common/CommandLine.h"

namespace
{
using namespace quadmap;

const std::map<std::string, void (*)(int, char**)> kCommands = {
    {   "info",    infoCommand},
    {  "query",   queryCommand},
    {"relabel", relabelCommand},
    { "remove",  removeCommand},
    {  "merge",   mergeCommand}
};

/** --help, --version, and what is wrong when no command is given. */
void withoutCommand(int argc, char** argv)
{
  std::vector<std::string> names;
  for (const auto& command : kCommands) names.push_back(command.first);
  TCLAP::ValuesConstraint<std::string> known(names);
  cli::CommandLine line(
      "quadmap-map",
      "Looks into an object map or changes it. Each command has its own --help: "
      "quadmap-map query --help.",
      QUADMAP_VERSION);
  TCLAP::UnlabeledValueArg<std::string> command(
      "COMMAND", "What to do.", true, "", &known, line.args());
  line.parse(argc, argv);
}
}  // namespace

int main(int argc, char** argv)
{
  return cli::runMain(
      "quadmap-map",
      [&]
      {
        const auto command = argc > 1 ? kCommands.find(argv[1]) : kCommands.end();
        if (command == kCommands.end())
          withoutCommand(argc, argv);
        else
          command->second(argc - 1, argv + 1);
      });
}
