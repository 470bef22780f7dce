#include <gtest/gtest.h>

#include <filesystem>

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
