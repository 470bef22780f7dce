#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "RunProgram.h"

using namespace quadmap;

namespace
{
/** Calls programs in a folder that has nothing but links. */
class SeveralOutputs : public ::testing::Test
{
 protected:
  SeveralOutputs()
  {
    std::filesystem::create_symlink("a.png", folder_.path("link.png"));
    std::filesystem::create_symlink("a", folder_.path("link.json"));
  }

  ProgramResult run(const std::string& command) const
  {
    return runCommand(
        "( cd '" + folder_.folder().string() + "' && '" QUADMAP_BIN_DIR "'/" + command + " )");
  }

  TemporaryFolder folder_;
};
}  // namespace

TEST_F(SeveralOutputs, AreRefusedBeforeAnyWorkWhenTwoAreTheSameFile)
{
  const std::string write = "quadmap-export missing ", judge = "quadmap-evaluate . --objects gt ";
  for (const auto& [command, both] :
       {std::pair(write + "--png a.png --top ./a.png", "--top: ./a.png is the file of --png"),
        std::pair(write + "--top link.png --png a.png", "--top: link.png is the file of --png"),
        std::pair(write + "--ply a --cloud a.ply --glb $PWD/a", "/a is the file of --ply"),
        std::pair(write + "--json link.json --scene a", "--json: link.json is the file of"),
        std::pair(judge + "--json b --html ./b", "--html: ./b is the file of --json"),
        std::pair(
            std::string("quadmap-simulate random -o a --write-scene ../$(basename $PWD)/a"),
            "/a is the file of -o")})
  {
    const auto result = run(command);
    EXPECT_EQ(result.status, 2) << command;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(both), kNotFound) << result.err;
  }
  EXPECT_EQ(folder_.fileCount(), 2u) << "the links";
}

TEST_F(SeveralOutputs, MayBeEqualWhereNothingIsKept)
{
  const auto result = run("quadmap-export missing --json /dev/null --ply /dev/null");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("missing: there is no such file or folder"), kNotFound) << result.err;
}
