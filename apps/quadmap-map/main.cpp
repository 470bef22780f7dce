#include "Commands.h"
#include "common/Subcommands.h"

int main(int argc, char** argv)
{
  using namespace quadmap;
  return cli::runSubcommands(
      "quadmap-map", "Looks into an object map or changes it.",
      {
          {   "info",    infoCommand},
          {  "query",   queryCommand},
          {"relabel", relabelCommand},
          { "remove",  removeCommand},
          {  "merge",   mergeCommand},
          {  "apply",   applyCommand}
  },
      argc, argv);
}
