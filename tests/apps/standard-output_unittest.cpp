#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "../folders/SampleRecording.h"
#include "RunProgram.h"
#include "SampleMap.h"

using namespace quadmap;

namespace
{
/** Runs a program with its standard output somewhere else. \param to As typed in a shell. */
ProgramResult printing(const std::string& to, const std::string& program)
{
  return runCommand("( '" + std::string(QUADMAP_BIN_DIR) + "'/" + program + " " + to + " )");
}

/** Runs a program with output into a pipe that nobody reads any more.
 * \param closed As typed in a shell, with &9 for the pipe. */
ProgramResult printingIntoClosedPipe(const std::string& closed, const std::string& program)
{
  int pipe[2];
  EXPECT_EQ(::pipe(pipe), 0);
  constexpr int kNumber = 9;  // shells know one digit
  const int before = ::dup(kNumber);
  EXPECT_EQ(::dup2(pipe[1], kNumber), kNumber);
  ::close(pipe[0]);
  ::close(pipe[1]);
  const ProgramResult result = printing(closed, program);
  before < 0 ? ::close(kNumber) : ::dup2(before, kNumber);
  if (before >= 0) ::close(before);
  return result;
}
}  // namespace

TEST(StandardOutput, ThatCannotBeWrittenFails)
{
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  sampleMap().saveToFile(folder.path("objects.quadmap"));
  const std::string query = "quadmap-map query " + folder.path("objects.quadmap") + " chairs";
  EXPECT_EQ(printing("", query).status, 0);
  for (const std::string& program : {query, std::string("quadmap-slam --defaults")})
    for (const std::string to : {">/dev/full", ">&-"})
    {
      const auto result = printing(to, program);
      EXPECT_EQ(result.status, 1) << program << ' ' << to;
      EXPECT_TRUE(isOneLine(result.err)) << result.err;
      EXPECT_NE(result.err.find("the standard output cannot be written"), kNotFound) << result.err;
    }
}

TEST(StandardOutput, ThatIsClosedGoesIntoNoFile)
{
  const TemporaryFolder folder;
  sampleMap().saveToFile(folder.path("objects.quadmap"));
  const std::string scene = folder.path("map.json");
  const std::string write =
      "quadmap-export " + folder.path("objects.quadmap") + " --json " + scene + " ";
  ASSERT_EQ(printing("", write).status, 0);
  const std::string expected = readFile(scene);
  printing(">&-", write);
  EXPECT_EQ(readFile(scene), expected);
}

TEST(StandardOutput, ThatNobodyReadsAnyMoreLeavesTheFilesAsTheyShouldBe)
{
  const SampleRecording recording;
  std::filesystem::remove(recording.files.path("rgb/f3.png"));  // which is told
  for (const auto& [closed, status] : {
           std::pair("2>&9", 0), {     ">&9", 1},
             {">&9 2>&9", 1}
  })
  {
    const TemporaryFolder out;
    const auto result = printingIntoClosedPipe(
        closed,
        "quadmap-import tum " + recording.folder() + " --keep-going -o " + out.path("x.rawlog"));
    EXPECT_EQ(result.status, status) << closed << result.err;
    EXPECT_EQ(out.fileCount(), 2u) << closed << ": rawlog and boxes";
    EXPECT_TRUE(std::filesystem::is_regular_file(out.path("x.rawlog"))) << closed;
  }
}
