#pragma once

namespace quadmap
{
/** What the argument MAP of all sub-commands may be, for --help. */
inline constexpr const char* kMapHelp =
    "A folder that quadmap-slam wrote, its objects.quadmap, or its objects.simplemap, which is "
    "mapped anew.";

/** The sub-commands of quadmap-map. `argv[0]` is the sub-command's name.
 * \exception cli::UsageError For wrong arguments. \exception std::runtime_error Names the file. */
void infoCommand(int argc, char** argv);
void queryCommand(int argc, char** argv);
void relabelCommand(int argc, char** argv);
void removeCommand(int argc, char** argv);
void mergeCommand(int argc, char** argv);
void applyCommand(int argc, char** argv);

}  // namespace quadmap
