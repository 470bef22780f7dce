// Sees in which order files, names and folders reach the disk, by standing in for the calls of the
// C library.
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "../obs/TemporaryFolder.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/base/OutputSet.h"

using namespace quadmap;
namespace fs = std::filesystem;

namespace
{
/** What the calls of this thread did since it exists, one line each. */
class CallRecord
{
 public:
  CallRecord() { current() = this; }
  ~CallRecord() { current() = nullptr; }
  CallRecord(const CallRecord&) = delete;
  CallRecord& operator=(const CallRecord&) = delete;

  static CallRecord*& current()
  {
    thread_local CallRecord* record = nullptr;
    return record;
  }

  std::ptrdiff_t indexOf(const std::string& call) const
  {
    const auto found = std::find(calls.begin(), calls.end(), call);
    EXPECT_NE(found, calls.end()) << call;
    return found - calls.begin();
  }

  std::vector<std::string> calls;
};

/** Name by which a descriptor is open. */
std::string nameOf(int descriptor)
{
  std::error_code ignored;
  return fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor), ignored).string();
}
}  // namespace

extern "C" int fsync(int descriptor)
{
  if (auto* record = CallRecord::current()) record->calls.push_back("sync " + nameOf(descriptor));
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

extern "C" int rename(const char* from, const char* to) noexcept
{
  if (auto* record = CallRecord::current())
    record->calls.push_back(std::string("rename ") + from + " to " + to);
  return static_cast<int>(::syscall(SYS_rename, from, to));
}

extern "C" int syncfs(int descriptor) noexcept
{
  if (auto* record = CallRecord::current()) record->calls.push_back("sync all");
  return static_cast<int>(::syscall(SYS_syncfs, descriptor));
}

TEST(SyncOrder, AFileIsOnTheDiskBeforeItsNameAndTheNameBeforeTheEnd)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("objects.json");
  OutputFile output(path);
  std::ofstream(output.temporaryPath()) << "{}";
  const std::string temporary = output.temporaryPath();
  const CallRecord record;
  output.commit();
  EXPECT_EQ(
      record.calls, (std::vector<std::string>{
                        "sync " + temporary, "rename " + temporary + " to " + path,
                        "sync " + folder.folder().string()}));
}

TEST(SyncOrder, FilesOfARunAreOnTheDiskBeforeTheirListAndTheListBeforeTheirNames)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("a.txt"), staging = folder.path(".run.partial");
  OutputSet set(folder.folder().string(), "run");
  std::ofstream(set.add("a.txt")) << "a";
  const CallRecord record;
  set.commit();
  EXPECT_EQ(record.indexOf("sync all"), 0);
  const auto listIsThere = record.indexOf("sync " + staging);
  const auto named = record.indexOf("rename " + staging + "/a.txt to " + path);
  EXPECT_LT(listIsThere, named);
  EXPECT_LT(named, record.indexOf("sync " + folder.folder().string()));
}
