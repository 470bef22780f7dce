#include "quadmap/base/OutputSet.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>

#include "../obs/TemporaryFolder.h"
#include "quadmap/base/GzipInput.h"
#include "quadmap/base/OutputFile.h"

using namespace quadmap;
namespace fs = std::filesystem;

namespace
{
constexpr const char* kNames[] = {"a.txt", "b.json", "c.bin"};

/** Writes the same text into all files of a set. */
void writeSet(const TemporaryFolder& folder, const std::string& text)
{
  OutputSet set(folder.folder().string(), "run");
  for (const auto* name : kNames) writeTextFile(set.add(name), text);
  set.commit();
}

/** The texts of the files, as a program reads them that refuses mixtures. */
std::vector<std::string> readSet(const TemporaryFolder& folder)
{
  std::vector<std::string> texts;
  for (const auto* name : kNames)
  {
    requireOneRun(folder.path(name));
    texts.push_back(readFile(folder.path(name)));
  }
  return texts;
}

/** Leaves what a program leaves in a folder that is killed while it replaces files: a list, each
 * entry of which starts with '+' or '-'. */
void leaveList(const TemporaryFolder& folder, const std::vector<std::string>& entries)
{
  fs::create_directories(folder.path("given/.run.partial"));
  std::string list;
  for (const auto& entry : entries) list += entry + '\0';
  folder.write("given/.run.partial/.exchange", list);
}

/** The first file is replaced, the second cannot be: its link points into a folder that is missing.
 */
void leaveMixture(const TemporaryFolder& folder)
{
  writeSet(folder, "old");
  fs::remove(folder.path("b.json"));
  fs::create_symlink("missing/b.json", folder.path("b.json"));
  EXPECT_NE(errorOf([&] { writeSet(folder, "new"); }).find("b.json"), std::string::npos);
  ASSERT_EQ(readFile(folder.path("a.txt")), "new");
  ASSERT_EQ(readFile(folder.path("c.bin")), "old");
}
}  // namespace

TEST(OutputSet, NothingChangesBeforeCommitAndEverythingByIt)
{
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  folder.write("stale.txt", "old");
  folder.write("other.txt", "of the user");
  {
    OutputSet set(folder.folder().string(), "run");
    writeTextFile(set.add("a.txt"), "new");
    writeTextFile(set.add("b.json"), "new");
    set.addRemoval("stale.txt");
    EXPECT_EQ(readFile(folder.path("a.txt")), "old");
    EXPECT_FALSE(fs::exists(folder.path("b.json")));
    set.commit();
  }
  EXPECT_EQ(readFile(folder.path("a.txt")), "new");
  EXPECT_EQ(readFile(folder.path("b.json")), "new");
  EXPECT_EQ(readFile(folder.path("other.txt")), "of the user");
  EXPECT_EQ(folder.fileCount(), 3u) << "without stale.txt and the hidden folder";
}

TEST(OutputSet, WithoutCommitNoTraceIsLeft)
{
  const TemporaryFolder folder;
  {
    OutputSet set(folder.folder().string(), "run");
    writeTextFile(set.add("a.txt"), "new");
  }
  EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(OutputSet, AMissingFileIsNoticedBeforeAnyIsReplaced)
{
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  OutputSet set(folder.folder().string(), "run");
  writeTextFile(set.add("a.txt"), "new");
  set.add("b.json");
  EXPECT_NE(errorOf([&] { set.commit(); }).find(folder.path("b.json")), std::string::npos);
  EXPECT_EQ(readFile(folder.path("a.txt")), "old");
}

TEST(OutputSet, FilesKeepTheirPermissionsAndLinksStayLinks)
{
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  ::chmod(folder.path("a.txt").c_str(), 0600);
  fs::create_directory(folder.path("elsewhere"));
  fs::create_symlink("elsewhere/b.json", folder.path("b.json"));
  writeSet(folder, "new");
  struct stat s;
  ASSERT_EQ(::stat(folder.path("a.txt").c_str(), &s), 0);
  EXPECT_EQ(s.st_mode & 0777u, 0600u);
  EXPECT_TRUE(fs::is_symlink(folder.path("b.json")));
  EXPECT_EQ(readFile(folder.path("elsewhere/b.json")), "new");
}

TEST(OutputSet, TwoProgramsExcludeEachOtherAndADeadOneLocksNothing)
{
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0)
  {
    OutputSet set(folder.folder().string(), "run");
    writeTextFile(set.add("a.txt"), "of the child");
    writeTextFile(folder.path("ready"), "");
    ::pause();  // until it is killed
  }
  while (!fs::exists(folder.path("ready"))) ::usleep(1000);
  EXPECT_NE(
      errorOf([&] { OutputSet(folder.folder().string(), "run"); }).find("another program"),
      std::string::npos);
  EXPECT_EQ(errorOf([&] { OutputSet(folder.folder().string(), "other"); }), "");
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(errorOf([&] { writeSet(folder, "new"); }), "");
  EXPECT_EQ(readSet(folder), std::vector<std::string>(3, "new"));
  EXPECT_EQ(folder.fileCount(), 4u) << "what the child left is gone";
}

TEST(OutputSet, AMixtureIsRefusedFileByFile)
{
  const TemporaryFolder folder;
  folder.write("other.txt", "");
  leaveMixture(folder);
  for (const auto* name : kNames)
    EXPECT_NE(
        errorOf([&] { requireOneRun(folder.path(name)); }).find("two runs"), std::string::npos)
        << name;
  EXPECT_EQ(errorOf([&] { requireOneRun(folder.path("other.txt")); }), "") << "is of no set";
}

TEST(OutputSet, AMixtureIsRefusedBehindALinkOfAnotherName)
{
  const TemporaryFolder folder, other;
  leaveMixture(folder);
  for (const auto* name : kNames)  // one of them is a link itself
  {
    const std::string link = other.path(std::string("another ") + name);
    fs::create_symlink(folder.path(name), link);
    EXPECT_NE(errorOf([&] { requireOneRun(link); }).find("two runs"), std::string::npos) << name;
  }
}

TEST(OutputSet, FilesThatAreNoResultsAreOpenedWithoutASearch)
{
  const TemporaryFolder folder;
  leaveMixture(folder);
  EXPECT_THROW(GzInput(folder.path("a.txt")), std::runtime_error);
  EXPECT_NO_THROW(GzInput(folder.path("a.txt"), false));
}

TEST(OutputSet, TheNextProgramCompletesAMixture)
{
  const TemporaryFolder folder;
  leaveMixture(folder);
  fs::remove(folder.path("b.json"));
  {
    const OutputSet next(folder.folder().string(), "run");  // and writes nothing itself
  }
  EXPECT_EQ(readSet(folder), std::vector<std::string>(3, "new"));
  EXPECT_EQ(folder.fileCount(), 3u);
}

TEST(OutputSet, AListFromAStrangerReachesNothingOutside)
{
  const TemporaryFolder folder;
  folder.write("mine.txt", "mine");
  leaveList(folder, {"-../mine.txt", "-" + folder.path("mine.txt")});
  OutputSet set(folder.path("given"), "run");
  EXPECT_TRUE(fs::exists(folder.path("mine.txt")));
}

TEST(OutputSet, AListFromAStrangerReachesNothingBehindALinkedFolder)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.path("home"));
  folder.write("home/mine.txt", "mine");
  leaveList(folder, {"-d/mine.txt", "+d/planted.txt"});
  fs::create_directory_symlink("../home", folder.path("given/d"));
  fs::create_directory(folder.path("given/.run.partial/d"));
  folder.write("given/.run.partial/d/planted.txt", "evil");
  const OutputSet set(folder.path("given"), "run");
  EXPECT_TRUE(fs::exists(folder.path("home/mine.txt")));
  EXPECT_FALSE(fs::exists(folder.path("home/planted.txt")));
}

TEST(OutputSet, AStagedFileOfAStrangerDoesNotLeaveTheFolderByALink)
{
  for (const bool exists : {false, true})
  {
    const TemporaryFolder folder;
    if (exists) folder.write("mine.txt", "mine");
    leaveList(folder, {"+a.txt"});
    folder.write("given/.run.partial/a.txt", "evil");
    fs::create_symlink("../mine.txt", folder.path("given/a.txt"));
    const auto error = errorOf([&] { OutputSet(folder.path("given"), "run"); });
    EXPECT_NE(error.find("given/a.txt: is a link out"), std::string::npos) << error;
    ASSERT_EQ(fs::exists(folder.path("mine.txt")), exists);
    EXPECT_TRUE(!exists || readFile(folder.path("mine.txt")) == "mine");
  }
}

TEST(OutputSet, ACircleOfLinksThatWasLeftIsToBeRemoved)
{
  for (const char* link : {"given/a.txt", "given/.run.partial/a.txt"})
  {
    const TemporaryFolder folder;
    leaveList(folder, {"+a.txt"});
    fs::create_symlink("a.txt", folder.path(link));
    EXPECT_EQ(
        errorOf([&] { OutputSet(folder.path("given"), "run"); }),
        folder.path(link) +
            ": Too many levels of symbolic links, and a killed program left it to "
            "be written: remove it");
  }
}

TEST(OutputSet, AStagedLinkOfAStrangerChangesNoPermissions)
{
  const TemporaryFolder folder;
  folder.write("mine.txt", "mine");
  fs::permissions(folder.path("mine.txt"), fs::perms(0600));
  leaveList(folder, {"+a.txt"});
  folder.write("given/a.txt", "");
  fs::permissions(folder.path("given/a.txt"), fs::perms(0666));
  fs::create_symlink("../../mine.txt", folder.path("given/.run.partial/a.txt"));
  EXPECT_NE(
      errorOf([&] { OutputSet(folder.path("given"), "run"); }).find("link"), std::string::npos);
  EXPECT_EQ(fs::status(folder.path("mine.txt")).permissions(), fs::perms(0600));
}

TEST(OutputSet, AHiddenFolderThatIsALinkIsNotEmptied)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.path("given"));
  fs::create_directory(folder.path("home"));
  folder.write("home/mine.txt", "mine");
  fs::create_directory_symlink("../home", folder.path("given/.run.partial"));
  const auto error = errorOf([&] { OutputSet(folder.path("given"), "run"); });
  EXPECT_NE(error.find("given/.run.partial: "), std::string::npos) << error;
  EXPECT_EQ(readFile(folder.path("home/mine.txt")), "mine");
}

TEST(OutputSet, AListThatIsAPipeKeepsNobodyWaiting)
{
  const TemporaryFolder folder;
  leaveList(folder, {});
  const std::string list = folder.path("given/.run.partial/.exchange");
  fs::remove(list);
  ASSERT_EQ(::mkfifo(list.c_str(), 0600), 0);
  EXPECT_EQ(errorOf([&] { requireOneRun(folder.path("given/a.txt")); }), "");
  EXPECT_EQ(errorOf([&] { OutputSet(folder.path("given"), "run"); }), "");
}

TEST(OutputSet, ADeviceThatTakesNothingFailsBeforeAnyFileIsReplaced)
{
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  fs::create_symlink("/dev/full", folder.path("b.json"));
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{1} << 20})
  {
    const auto error = errorOf([&] { writeSet(folder, std::string(bytes, 'x')); });
    EXPECT_NE(error.find("/dev/full: cannot be written: No space left"), std::string::npos)
        << error;
    EXPECT_EQ(readFile(folder.path("a.txt")), "old");
    EXPECT_EQ(folder.fileCount(), 2u) << "nothing is left to be completed";
  }
}

TEST(OutputSet, ADeviceStaysOneAndEmptyFilesAreNoError)
{
  const TemporaryFolder folder;
  fs::create_symlink("/dev/null", folder.path("b.json"));
  for (const std::string text : {"", "new"})
  {
    writeSet(folder, text);
    EXPECT_TRUE(fs::is_character_file(folder.path("b.json")));
    EXPECT_EQ(readFile(folder.path("c.bin")), text);
  }
}

TEST(OutputSet, KilledAtAnyMomentNoReaderSeesAMixture)
{
  const TemporaryFolder folder;
  writeSet(folder, "first");
  std::mt19937 random(7);
  for (int round = 0; round < 30; ++round)
  {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
      for (int run = 0;; ++run) writeSet(folder, std::to_string(round) + " " + std::to_string(run));
    ::usleep(static_cast<useconds_t>(random() % 20000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    std::vector<std::string> texts;
    if (!errorOf([&] { texts = readSet(folder); }).empty()) continue;  // refused
    EXPECT_EQ(texts, std::vector<std::string>(3, texts.at(0)));
  }
  writeSet(folder, "last");
  EXPECT_EQ(readSet(folder), std::vector<std::string>(3, "last"));
  EXPECT_EQ(folder.fileCount(), 3u);
}
