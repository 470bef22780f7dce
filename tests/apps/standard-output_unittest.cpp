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

TEST(StandardOutput, ThatIsAnOutputHasNothingElse)
{
  const TemporaryFolder folder;
  const CQuadricObjectMap map = sampleMap();
  map.saveToFile(folder.path("objects.quadmap"));
  writeObjectsJson(folder.path("gt.json"), map.toRecords());
  std::filesystem::create_symlink("/dev/stdout", folder.path("printed"));
  for (const std::string command :
       {"export DIR/objects.quadmap --json OUT", "export DIR/objects.quadmap --ply OUT",
        "evaluate DIR/objects.quadmap --objects DIR/gt.json --in-place --json OUT",
        "simulate random -o DIR/x.rawlog --frames 2 --resolution 64x64 --write-scene OUT",
        "import rawlog DIR/x.rawlog -o OUT", "map remove DIR/objects.quadmap --id 1 -o OUT"})
  {
    const auto writing = [&](const std::string& output, const std::string& to)
    {
      const std::string program = "quadmap-" + replaced(command, "DIR", folder.folder().string());
      return printing(to, replaced(program, "OUT", folder.path(output)));
    };
    const auto apart = writing("file", "");
    ASSERT_EQ(apart.status, 0) << apart.err;
    EXPECT_NE(apart.out, "") << command;
    const auto together = writing("printed", "| cat");
    const std::string expected = readFile(folder.path("file"));
    EXPECT_TRUE(together.out == expected)
        << command << ": " << together.out.size() << " bytes in place of " << expected.size();
    EXPECT_NE(together.err, "") << command;
  }
  const std::string write = "quadmap-export " + folder.path("objects.quadmap") + " --json ";
  EXPECT_EQ(printing(">/dev/null", write + "/dev/null").err, "");
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
