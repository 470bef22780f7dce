#pragma once

#include <sys/wait.h>

#include <algorithm>
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

constexpr auto kNotFound = std::string::npos;

inline bool isOneLine(const std::string& text)
{
  return std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

/** The text with each `word` in it replaced. */
inline std::string replaced(std::string text, const std::string& word, const std::string& value)
{
  for (auto at = text.find(word); at != kNotFound; at = text.find(word, at + value.size()))
    text.replace(at, word.size(), value);
  return text;
}

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
