#include "Judge.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

namespace quadmap::torture
{
namespace
{
namespace fs = std::filesystem;

constexpr unsigned kSeconds = 10;
constexpr long kMostKilobytes = 1l << 20;     // of memory
constexpr rlim_t kMachine = rlim_t{8} << 30;  // so that a failing case harms no other program

struct Ending
{
  int status = -1;  // -1 when a signal ended the program
  long kilobytes = 0;
  std::string out, err;
};

void replaceAll(std::string& text, const std::string& word, const std::string& value)
{
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
    text.replace(at, word.size(), value);
}

/** In the child: never returns. */
[[noreturn]] void become(const std::string& command)
{
  const rlimit limit{kMachine, kMachine};
  ::setrlimit(RLIMIT_AS, &limit);
  ::alarm(kSeconds);  // stays set in the program
  ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  ::_exit(127);
}

/** What the program said. The decoders of images print notes of their own, which cannot be turned
 * off through OpenCV. */
std::string withoutNotesOfDecoders(const std::string& text)
{
  std::istringstream lines(text);
  std::string rest;
  for (std::string line; std::getline(lines, line);)
  {
    const auto begins = [&line](const char* note) { return line.rfind(note, 0) == 0; };
    if (!begins("Corrupt JPEG data") && !begins("Premature end of JPEG") && !begins("libpng "))
      rest += line + "\n";
  }
  return rest;
}

Ending runToEnd(const std::string& command)
{
  const TemporaryFolder output;
  const std::string redirected =
      "exec " + command + " >'" + output.path("out") + "' 2>'" + output.path("err") + "'";
  const pid_t child = ::fork();
  if (child == 0) become(redirected);
  int status = 0;
  rusage usage{};
  EXPECT_EQ(::wait4(child, &status, 0, &usage), child);
  return {
      WIFEXITED(status) ? WEXITSTATUS(status) : -1, usage.ru_maxrss, readFile(output.path("out")),
      withoutNotesOfDecoders(readFile(output.path("err")))};
}

std::set<std::string> filesIn(const fs::path& folder)
{
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(entry.path().string());
  return names;
}

/** Whether the text is one line, of characters that a terminal shows. */
bool isOneLine(const std::string& text)
{
  const auto isControl = [](unsigned char c) { return c < ' ' && c != '\n'; };
  return std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n' &&
         std::none_of(text.begin(), text.end(), isControl);
}

void expectGoodEnding(const Ending& ending, const Reader& reader, const Case& c)
{
  const std::string program = reader.command.substr(0, reader.command.find(' '));
  EXPECT_LT(ending.kilobytes, kMostKilobytes);
  EXPECT_TRUE(ending.status == 0 || ending.status == 1) << ending.status << ": " << ending.err;
  if (c.mustFail)
  {
    EXPECT_EQ(ending.status, 1) << ending.out << ending.err;
  }
  if (ending.status == 0) return;
  EXPECT_TRUE(isOneLine(ending.err)) << ending.err.substr(0, 2000);
  EXPECT_EQ(ending.err.rfind(program + ": ", 0), 0u) << ending.err.substr(0, 2000);
  const std::string name = reader.mention.empty() ? reader.file : reader.mention;
  EXPECT_NE(ending.err.find(name), std::string::npos) << ending.err.substr(0, 2000);
}

}  // namespace

void judge(const TemporaryFolder& folder, const Reader& reader, const std::vector<Case>& cases)
{
  const fs::path out = folder.folder() / "OUT";
  for (const Case& c : cases)
  {
    SCOPED_TRACE(reader.file + ": " + c.name);
    folder.write(reader.file, c.bytes);
    const auto before = filesIn(folder.folder());
    std::string command = QUADMAP_BIN_DIR "/" + reader.command;
    replaceAll(command, " IN", " " + folder.path(reader.file));
    replaceAll(command, "OUT", out.string());
    replaceAll(command, "DIR", folder.folder().string());
    const Ending ending = runToEnd(command);
    expectGoodEnding(ending, reader, c);
    if (ending.status != 0)
    {
      EXPECT_EQ(filesIn(folder.folder()), before) << "files were left";
    }
    fs::remove_all(out);
  }
}

}  // namespace quadmap::torture
