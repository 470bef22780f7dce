#include "quadmap/base/OutputGroup.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "../obs/TemporaryFolder.h"
#include "quadmap/base/OutputFile.h"

using namespace quadmap;

namespace
{
/** The folder that paths without one are in, as long as this object lives. */
class WorkingFolder
{
 public:
  explicit WorkingFolder(const std::filesystem::path& folder)
  {
    std::filesystem::current_path(folder);
  }
  ~WorkingFolder() { std::filesystem::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
};

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

TEST_F(OutputGroups, NameFilesAsTheUserDid)
{
  namespace fs = std::filesystem;
  const WorkingFolder here(folder_.folder());
  fs::create_directory("full");
  for (const std::string name : {"full", "./full", "new/../full"})
    EXPECT_EQ(
        errorOf([&] { OutputGroup().add(name); }), name + ": cannot be written: Is a directory");
  const OutputSet other("", "mine.txt");
  EXPECT_EQ(
      errorOf([&] { group_->add("mine.txt"); }).find("mine.txt: another program is writing it"),
      0u);
  EXPECT_EQ(
      errorOf([&] { OutputSet("", "set").addFolder("full"); }).find("full: exists already"), 0u);
  OutputGroup next;
  next.add("missing.txt");
  EXPECT_EQ(
      errorOf([&] { next.commit(); }), "missing.txt: cannot be written: No such file or directory");
}

TEST_F(OutputGroups, AreCompletedWhereTheProgramWasStarted)
{
  namespace fs = std::filesystem;
  const WorkingFolder here(folder_.folder());
  group_.emplace();
  writeTextFile(group_->add("mine.txt"), "mine");
  fs::create_directories("mine.txt/full");  // by another program meanwhile
  EXPECT_EQ(errorOf([&] { group_->commit(); }), "mine.txt: cannot be written: Is a directory");
  group_.reset();
  fs::remove_all("mine.txt");
  const std::string mixed = errorOf([&] { requireOneRun("mine.txt"); });
  EXPECT_NE(mixed.find("(.mine.txt.partial has the rest)"), std::string::npos) << mixed;
  OutputSet("", "mine.txt");
  EXPECT_EQ(readFile("mine.txt"), "mine");
}

TEST_F(OutputGroups, WriteDevicesAtOnce) { EXPECT_EQ(group_->add("/dev/null"), "/dev/null"); }
