#include "quadmap/base/OutputGroup.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "../obs/TemporaryFolder.h"
#include "quadmap/base/OutputFile.h"

using namespace quadmap;

namespace
{
/** A group of files of two folders, one of which is to be made. */
class OutputGroups : public ::testing::Test
{
 protected:
  OutputGroups()
  {
    folder_.write("a.txt", "old");
    group_.emplace();
    writeTextFile(group_->add(folder_.path("a.txt")), "a");
    writeTextFile(group_->add(folder_.path("b.txt")), "b");
    OutputSet& files = group_->addFolder(folder_.path("new/pictures"), "pictures");
    writeTextFile(files.add("c.txt"), "c");
  }

  void expectNothingNew()
  {
    EXPECT_EQ(readFile(folder_.path("a.txt")), "old");
    EXPECT_EQ(folder_.fileCount(), 1u);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("new")));
  }

  TemporaryFolder folder_;
  std::optional<OutputGroup> group_;
};
}  // namespace

TEST_F(OutputGroups, AppearTogether)
{
  EXPECT_EQ(readFile(folder_.path("a.txt")), "old");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("b.txt")));
  group_->commit();
  EXPECT_EQ(readFile(folder_.path("a.txt")), "a");
  EXPECT_EQ(readFile(folder_.path("b.txt")), "b");
  EXPECT_EQ(readFile(folder_.path("new/pictures/c.txt")), "c");
  group_.reset();
  EXPECT_EQ(folder_.fileCount(), 3u);
}

TEST_F(OutputGroups, LeaveNothingWithoutACommit)
{
  group_.reset();
  expectNothingNew();
}

TEST_F(OutputGroups, LeaveNothingWhenOneOfThemFails)
{
  group_->addFolder(folder_.path("new/other"), "other").add("never-written.txt");
  const std::string error = errorOf([&] { group_->commit(); });
  EXPECT_EQ(error.find(folder_.path("new/other/never-written.txt")), 0u) << error;
  group_.reset();
  expectNothingNew();
}

TEST_F(OutputGroups, AreAsCompleteAsPossibleWhenTheExchangeFails)
{
  namespace fs = std::filesystem;
  fs::create_directories(folder_.path("b.txt/full"));  // by another program meanwhile
  const std::string error = errorOf([&] { group_->commit(); });
  EXPECT_EQ(error.find(folder_.path("b.txt")), 0u) << error;
  group_.reset();
  EXPECT_EQ(readFile(folder_.path("a.txt")), "a");
  EXPECT_EQ(readFile(folder_.path("new/pictures/c.txt")), "c");
  fs::remove_all(folder_.path("b.txt"));

  OutputGroup next;
  writeTextFile(next.add(folder_.path("a.txt")), "newer");
  next.commit();
  EXPECT_EQ(readFile(folder_.path("a.txt")), "newer");
  EXPECT_FALSE(fs::exists(folder_.path("b.txt")));
  OutputSet(folder_.folder().string(), "b.txt");  // who writes it next completes it first
  EXPECT_EQ(readFile(folder_.path("b.txt")), "b");
  EXPECT_EQ(readFile(folder_.path("a.txt")), "newer");
}

TEST_F(OutputGroups, WriteWhereALinkLeads)
{
  std::filesystem::create_directory(folder_.path("given"));
  const std::string target = folder_.write("given/target.txt", "old");
  std::filesystem::create_symlink(target, folder_.path("link.txt"));
  const std::string written = group_->add(folder_.path("link.txt"));
  EXPECT_EQ(written.find(folder_.path("given/")), 0u) << written;
  EXPECT_EQ(group_->add(target), written) << "the same file";
  writeTextFile(written, "new");
  group_->commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.path("link.txt")));
  EXPECT_EQ(readFile(target), "new");
}

TEST_F(OutputGroups, WriteDevicesAtOnce) { EXPECT_EQ(group_->add("/dev/null"), "/dev/null"); }
