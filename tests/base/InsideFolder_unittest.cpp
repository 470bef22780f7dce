#include "quadmap/base/InsideFolder.h"

#include <gtest/gtest.h>

#include "../obs/TemporaryFolder.h"

using namespace quadmap;
namespace fs = std::filesystem;

TEST(InsideFolder, FollowsLinks)
{
  const TemporaryFolder folder;
  folder.write("mine.txt", "");
  fs::create_directory(folder.path("given"));
  fs::create_symlink("../mine.txt", folder.path("given/out.txt"));
  fs::create_symlink("later.txt", folder.path("given/in.txt"));
  const auto isGiven = [&](const char* name)
  { return isInside(folder.path(name), folder.path("given")); };
  EXPECT_TRUE(isGiven("given/in.txt"));
  EXPECT_TRUE(isGiven("given/new.txt"));
  EXPECT_FALSE(isGiven("given/out.txt"));
  EXPECT_FALSE(isGiven("given/../mine.txt"));
}

TEST(InsideFolder, SaysWhyAPathCannotBeFollowed)
{
  const TemporaryFolder folder;
  fs::create_symlink("circle", folder.path("circle"));
  const auto expect = [&](const std::string& path, const std::string& why)
  { EXPECT_EQ(errorOf([&] { isInside(path, folder.folder()); }), path + ": " + why); };
  expect(folder.path("circle"), "Too many levels of symbolic links");
  expect(folder.path("circle/a.png"), "Too many levels of symbolic links");
  expect(folder.path(std::string(300, 'a')), "File name too long");
}
