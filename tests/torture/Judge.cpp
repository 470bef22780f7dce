#include "Judge.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

#include "ForkProtocol.h"

namespace quadmap::torture
{
namespace
{
namespace fs = std::filesystem;

constexpr long kMostKilobytes = 1l << 20;  // of memory

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

/** What the program said. The decoder of PNG images prints notes of its own, which cannot be turned
 * off through OpenCV. */
std::string withoutNotesOfDecoders(const std::string& text)
{
  std::istringstream lines(text);
  std::string rest;
  for (std::string line; std::getline(lines, line);)
  {
    if (line.rfind("libpng ", 0) != 0) rest += line + "\n";
  }
  return rest;
}

/** A program that is started once and run many times, each time in a process of its own. */
class Program
{
 public:
  explicit Program(const std::string& name) : name_(name)
  {
    int requests[2], endings[2];
    EXPECT_EQ(::pipe2(requests, O_CLOEXEC) + ::pipe2(endings, O_CLOEXEC), 0);
    server_ = ::fork();
    if (server_ == 0) become(requests[0], endings[1]);
    ::close(requests[0]);
    ::close(endings[1]);
    requests_ = requests[1];
    endings_ = endings[0];
  }
  ~Program()
  {
    ::close(requests_);  // ends the server
    ::close(endings_);
    int status = 0;
    ::waitpid(server_, &status, 0);
    EXPECT_EQ(status, 0) << name_ << " cannot be started";
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  Ending run(const std::vector<std::string>& arguments) const
  {
    const TemporaryFolder output;
    std::vector<std::string> words{output.path("out"), output.path("err"), name_};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const std::string request = requestOf(words);
    Ended ended;
    if (::write(requests_, request.data(), request.size()) !=
            static_cast<ssize_t>(request.size()) ||
        ::read(endings_, &ended, sizeof ended) != sizeof ended)
      return {};
    return {
        WIFEXITED(ended.status) ? WEXITSTATUS(ended.status) : -1, ended.kilobytes,
        readFile(output.path("out")), withoutNotesOfDecoders(readFile(output.path("err")))};
  }

 private:
  /** In the child: never returns. */
  [[noreturn]] void become(int requests, int endings) const
  {
    ::dup2(requests, kRequests);
    ::dup2(endings, kEndings);
    ::setenv("LD_PRELOAD", QUADMAP_FORK_SERVER, 1);
    const std::string path = QUADMAP_BIN_DIR "/" + name_;
    ::execl(path.c_str(), path.c_str(), nullptr);
    ::_exit(127);
  }

  std::string name_;
  pid_t server_ = 0;
  int requests_ = -1, endings_ = -1;
};

std::vector<std::string> wordsOf(const std::string& text)
{
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
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
  EXPECT_NE(ending.err.find(c.place), std::string::npos)
      << c.place << " is not in: " << ending.err.substr(0, 2000);
}

}  // namespace

void judge(const TemporaryFolder& folder, const Reader& reader, const std::vector<Case>& cases)
{
  const fs::path out = folder.folder() / "OUT";
  std::string line = reader.command;
  replaceAll(line, " IN", " " + folder.path(reader.file));
  replaceAll(line, "OUT", out.string());
  replaceAll(line, "DIR", folder.folder().string());
  auto arguments = wordsOf(line);
  const Program program(arguments.front());
  arguments.erase(arguments.begin());
  for (const Case& c : cases)
  {
    SCOPED_TRACE(reader.file + ": " + c.name);
    folder.write(reader.file, c.bytes);
    const auto before = filesIn(folder.folder());
    const Ending ending = program.run(arguments);
    expectGoodEnding(ending, reader, c);
    if (ending.status != 0)
    {
      EXPECT_EQ(filesIn(folder.folder()), before) << "files were left";
    }
    fs::remove_all(out);
  }
}

}  // namespace quadmap::torture
