#include "quadmap/base/OutputFile.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../obs/FileSizeLimit.h"
#include "../obs/TemporaryFolder.h"

using namespace quadmap;
namespace fs = std::filesystem;

namespace
{
/** A disk of a given size, where mounting one is allowed. */
class SmallDisk
{
 public:
  SmallDisk(std::string mountPoint, const std::string& size) : mountPoint_(std::move(mountPoint))
  {
    fs::create_directory(mountPoint_);
    mounted_ = ::mount("tmpfs", mountPoint_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  ~SmallDisk()
  {
    if (mounted_) ::umount2(mountPoint_.c_str(), MNT_DETACH);
  }
  bool mounted() const { return mounted_; }

 private:
  std::string mountPoint_;
  bool mounted_ = false;
};
}  // namespace

TEST(OutputFile, NothingAppearsUnderTheFinalNameBeforeCommit)
{
  const TemporaryFolder folder;
  const auto path = folder.path("objects.json");
  {
    OutputFile output(path);
    EXPECT_EQ(output.finalPath(), path);
    std::ofstream(output.temporaryPath()) << "half";
    EXPECT_FALSE(fs::exists(path));
    EXPECT_EQ(fs::path(output.temporaryPath()).parent_path(), folder.folder());
    EXPECT_EQ(fs::path(output.temporaryPath()).extension(), ".json") << "writers look at it";
  }
  EXPECT_EQ(folder.fileCount(), 0u) << "not committed: no trace";
}

TEST(OutputFile, CommitRenames)
{
  const TemporaryFolder folder;
  const auto path = folder.write("objects.json", "old");
  {
    OutputFile output(path);
    std::ofstream(output.temporaryPath()) << "new";
    EXPECT_EQ(readFile(path), "old");
    output.commit();
    EXPECT_EQ(readFile(path), "new");
    output.commit();  // does nothing the second time
  }
  EXPECT_EQ(readFile(path), "new");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(OutputFile, AReplacedFileKeepsItsPermissionsAndTheTemporaryOneIsNoMoreReadable)
{
  const TemporaryFolder folder;
  const auto permissionsOf = [](const std::string& path)
  { return fs::status(path).permissions() & fs::perms::all; };
  for (const auto permissions : {fs::perms(0600), fs::perms(0640), fs::perms(0400)})
  {
    const auto path = folder.write("a.txt", "old");
    fs::permissions(path, permissions);
    OutputFile output(path);
    EXPECT_EQ(permissionsOf(output.temporaryPath()), permissions | fs::perms::owner_write);
    output.commit();
    EXPECT_EQ(permissionsOf(path), permissions);
  }
}

TEST(OutputFile, AnOldFileSurvivesAFailure)
{
  const TemporaryFolder folder;
  const auto path = folder.write("a.txt", "old");
  {
    OutputFile output(path);
  }
  EXPECT_EQ(readFile(path), "old");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(OutputFile, CompressedFilesKeepBothExtensions)
{
  const TemporaryFolder folder;
  const OutputFile output(folder.path("cloud.txt.gz"));
  const auto temporary = output.temporaryPath();
  ASSERT_GT(temporary.size(), 7u);
  EXPECT_EQ(temporary.substr(temporary.size() - 7), ".txt.gz");
}

TEST(OutputFile, TwoWritersOfOneNameDoNotShareATemporaryFile)
{
  const TemporaryFolder folder;
  OutputFile a(folder.path("x.json")), b(folder.path("x.json"));
  EXPECT_NE(a.temporaryPath(), b.temporaryPath());
}

TEST(OutputFile, TheNextProgramRemovesWhatAKilledOneLeft)
{
  const TemporaryFolder folder;
  const auto path = folder.path("a.txt");
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const auto startWriter = [&]
  {
    const pid_t child = ::fork();
    if (child == 0)
    {
      OutputFile output(path);
      std::ofstream(output.temporaryPath()) << "half";
      if (::write(ready[1], "x", 1) == 1) ::pause();
      ::_exit(1);
    }
    char c = 0;
    EXPECT_EQ(::read(ready[0], &c, 1), 1);
    return child;
  };
  const auto killWriter = [](pid_t child)
  {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  };
  const std::string others[] = {".a.txt.12x.tmp.txt", ".b.txt.12.tmp.txt", ".a.txt.12.tmp"};
  for (const auto& name : others) folder.write(name, "of somebody else");
  killWriter(startWriter());
  ASSERT_EQ(folder.fileCount(), 4u);
  const pid_t living = startWriter();
  EXPECT_EQ(folder.fileCount(), 4u) << "that of the killed one gave way";
  writeTextFile(path, "whole");
  EXPECT_EQ(folder.fileCount(), 5u) << "that of the living one stays";
  killWriter(living);
  writeTextFile(path, "again");
  EXPECT_EQ(folder.fileCount(), 4u);
  EXPECT_EQ(readFile(path), "again");
  for (const auto& name : others) EXPECT_TRUE(fs::exists(folder.path(name))) << name;
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(OutputFile, FoldersThatDoNotExistOrCannotBeWrittenAreNamed)
{
  const TemporaryFolder folder;
  const auto missing = folder.path("none/objects.json");
  const auto error = errorOf([&] { OutputFile output(missing); });
  EXPECT_NE(error.find(missing), std::string::npos) << error;
  EXPECT_NE(error.find("No such file"), std::string::npos) << error;
  EXPECT_NE(
      errorOf([&] { OutputFile output(folder.folder().string()); }).find("directory"),
      std::string::npos);
  EXPECT_NE(errorOf([] { OutputFile output(""); }), "");
  EXPECT_NE(
      errorOf([] { OutputFile output("/proc/objects.json"); }).find("/proc/objects.json"),
      std::string::npos)
      << "nobody, root included, can create files there";
}

TEST(OutputFile, AReadOnlyFolderIsAnError)
{
  const TemporaryFolder folder;
  ASSERT_EQ(::chmod(folder.folder().c_str(), 0555), 0);
  constexpr uid_t kNobody = 65534;
  const bool isRoot = ::geteuid() == 0;  // root may write everywhere
  if (isRoot)
  {
    ASSERT_EQ(::seteuid(kNobody), 0);
  }
  const auto error = errorOf([&] { OutputFile output(folder.path("a.json")); });
  if (isRoot)
  {
    ASSERT_EQ(::seteuid(0), 0);
  }
  ::chmod(folder.folder().c_str(), 0700);
  EXPECT_NE(error.find("a.json"), std::string::npos) << error;
  EXPECT_NE(error.find("Permission denied"), std::string::npos) << error;
}

TEST(OutputFile, ATemporaryFileThatVanishedIsAnErrorAtCommit)
{
  const TemporaryFolder folder;
  OutputFile output(folder.path("a.json"));
  fs::remove(output.temporaryPath());
  EXPECT_NE(errorOf([&] { output.commit(); }).find("a.json"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder.path("a.json")));
}

TEST(OutputFile, AFullDiskIsNoticedEvenWhenTheWriterSwallowsItsErrors)
{
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path("disk"), "64k");
  if (!disk.mounted()) GTEST_SKIP() << "mounting a small disk needs root";
  const auto path = folder.path("disk/a.txt");
  {
    OutputFile output(path);
    std::ofstream(output.temporaryPath()) << std::string(200000, 'x');
    const auto error = errorOf([&] { output.commit(); });
    EXPECT_NE(error.find(path), std::string::npos) << error;
    EXPECT_NE(error.find("No space left"), std::string::npos) << error;
  }
  EXPECT_TRUE(fs::is_empty(folder.path("disk"))) << "neither the final nor the temporary file";
  EXPECT_NO_THROW(writeTextFile(path, "fits"));
}

TEST(OutputFile, ALinkStandsForItsTarget)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.path("real"));
  const auto target = folder.write("real/a.txt", "old");
  fs::create_symlink(target, folder.path("link.txt"));
  writeTextFile(folder.path("link.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.path("link.txt")));
  EXPECT_EQ(readFile(target), "new");
}

TEST(OutputFile, DevicesAreWrittenDirectlyAndStayDevices)
{
  writeTextFile("/dev/null", "gone");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(OutputFile, APipeNeedsAReader)
{
  const TemporaryFolder folder;
  const auto pipe = folder.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(errorOf([&] { writeTextFile(pipe, "text"); }), pipe + ": nobody reads this pipe");
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  writeTextFile(pipe, "text");
  char bytes[8];
  EXPECT_EQ(::read(reader, bytes, sizeof bytes), 4);
  EXPECT_EQ(::read(reader, bytes, sizeof bytes), 0) << "the reader would wait for more";
  ::close(reader);
}

TEST(OutputFile, WritesToAPipeWithoutAName)
{
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  writeTextFile("/proc/self/fd/" + std::to_string(ends[1]), "text");  // as /dev/stdout may be
  char bytes[8];
  ASSERT_EQ(::read(ends[0], bytes, sizeof bytes), 4);
  EXPECT_EQ(std::string(bytes, 4), "text");
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(WriteTextFile, WritesTheBytesGiven)
{
  const TemporaryFolder folder;
  const std::string text("a\r\n\0b", 5);
  writeTextFile(folder.path("a.txt"), text);
  EXPECT_EQ(readFile(folder.path("a.txt")), text);
  struct stat status
  {
  };
  ASSERT_EQ(::stat(folder.path("a.txt").c_str(), &status), 0);
  const auto mask = ::umask(0);
  ::umask(mask);
  EXPECT_EQ(status.st_mode & 0777, 0666u & ~mask) << "readable by others, as usual";
}

TEST(WriteTextFile, AFullDeviceIsAnError)
{
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const auto error = errorOf([] { writeTextFile("/dev/full", std::string(100000, 'x')); });
  EXPECT_NE(error.find("/dev/full"), std::string::npos) << error;
  EXPECT_NE(error.find("No space left"), std::string::npos) << error;
  EXPECT_NE(errorOf([] { writeTextFile("/dev/full", "x"); }), "") << "shows at closing only";
}

TEST(WriteTextFile, AFullDiskLeavesTheOldFileAndNoTemporaryOne)
{
  const TemporaryFolder folder;
  const auto path = folder.write("objects.json", "old");
  std::string error;
  {
    const FileSizeLimit limit(1000);
    error = errorOf([&] { writeTextFile(path, std::string(5000, 'x')); });
  }
  EXPECT_NE(error.find(path), std::string::npos) << error;
  EXPECT_EQ(readFile(path), "old");
  EXPECT_EQ(folder.fileCount(), 1u);
}
