#include "quadmap/base/SameOutput.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "../obs/TemporaryFolder.h"

using namespace quadmap;
namespace fs = std::filesystem;

TEST(SameOutput, IsFoundBehindSpellingsAndLinks)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.path("sub"));
  fs::create_directory_symlink("sub", folder.path("linked"));
  fs::create_symlink("sub/a.png", folder.path("a.png"));
  const auto isA = [&](const std::string& name)
  { return isSameOutput(folder.path("sub/a.png"), folder.path(name)); };
  for (const bool exists : {false, true})
  {
    if (exists) folder.write("sub/a.png", "");
    for (const char* name : {"sub/a.png", "./sub/../sub/a.png", "linked/a.png", "a.png"})
      EXPECT_TRUE(isA(name)) << name;
    for (const char* name : {"sub/b.png", "sub", "missing/a.png", "missing/../b.png"})
      EXPECT_FALSE(isA(name)) << name;
  }
  EXPECT_TRUE(isSameOutput("x.json", fs::current_path() / "x.json"));
  EXPECT_FALSE(isSameOutput("x.json", "x"));
}

TEST(SameOutput, IsSaidOfLinksInACircleWhenTheirNamesAreEqual)
{
  const TemporaryFolder folder;
  fs::create_symlink("circle", folder.path("circle"));
  EXPECT_TRUE(isSameOutput(folder.path("circle"), folder.path("circle")));
  EXPECT_FALSE(isSameOutput(folder.path("circle"), folder.path("other")));
}

TEST(SameOutput, IsAPipeButNoDeviceThatTakesSeveralOutputs)
{
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.path("pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder.path("link"));
  EXPECT_TRUE(isSameOutput(folder.path("pipe"), folder.path("link")));
  EXPECT_FALSE(isSameOutput(folder.path("pipe"), folder.path("file")));
  EXPECT_FALSE(isSameOutput("/dev/null", "/dev/null"));
}
