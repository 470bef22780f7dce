#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cctype>
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

/** The text with each `word` in it replaced, but not where it is part of another one: the random
 * name of a temporary folder may have its letters. */
inline std::string replaced(std::string text, const std::string& word, const std::string& value)
{
  const auto isLetter = [](const std::string& of, std::size_t i)
  { return i < of.size() && std::isalnum(static_cast<unsigned char>(of[i])) != 0; };
  for (auto at = text.find(word); at != kNotFound;)
  {
    const std::size_t end = at + word.size();
    const bool isPart =
        isLetter(word, 0) && ((at > 0 && isLetter(text, at - 1)) || isLetter(text, end));
    if (!isPart) text.replace(at, word.size(), value);
    at = text.find(word, at + (isPart ? 1 : value.size()));
  }
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
