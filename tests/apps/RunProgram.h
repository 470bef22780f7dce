#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "../obs/TemporaryFolder.h"

namespace quadmap
{
struct ProgramResult
{
  int status = -1;       //!< Exit status; -1 when a signal ended it
  std::string out, err;  //!< What the program printed
};

/** Runs a command as typed in a shell to its end. */
inline ProgramResult runCommand(const std::string& command)
{
  const TemporaryFolder folder;
  const std::string redirected =
      command + " >'" + folder.path("out") + "' 2>'" + folder.path("err") + "'";
  const int status = std::system(redirected.c_str());
  return {
      WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(folder.path("out")),
      readFile(folder.path("err"))};
}

/** Runs one of our programs to its end. \param arguments Arguments as typed in a shell. */
inline ProgramResult runProgram(const std::string& program, const std::string& arguments)
{
  return runCommand(std::string(QUADMAP_BIN_DIR) + "/" + program + " " + arguments);
}

}  // namespace quadmap
