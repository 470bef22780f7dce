#include "quadmap/sensors/MemoryGuard.h"

#include <mrpt/core/aligned_allocator.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <mutex>
#include <new>

namespace quadmap
{
namespace
{
/** Private memory of the process [bytes]; 0 when the system does not tell. */
rlim_t memoryNow()
{
  std::ifstream file("/proc/self/statm");
  rlim_t total = 0, resident = 0, shared = 0, text = 0, unused = 0, data = 0;
  file >> total >> resident >> shared >> text >> unused >> data;
  return file ? data * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

/** The limit belongs to the process, and so do these. */
std::mutex mutex;
int guards = 0;

/** It is asked for once: a small record takes as long to read as a call to the system, and a file
 * may have a million of them. */
const rlimit& limitWithoutGuards()
{
  static const rlimit limit = []
  {
    rlimit now{};
    ::getrlimit(RLIMIT_DATA, &now);
    return now;
  }();
  return limit;
}

/** The memory of the process as it was a moment ago [bytes]. To ask the system takes ten times as
 * long as to read a small record. */
rlim_t recentMemory()
{
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kMoment(1);  // allocates less than the limit by far
  static Clock::time_point askedAt;
  static rlim_t answer = 0;
  if (const auto now = Clock::now(); answer == 0 || now - askedAt > kMoment)
  {
    askedAt = now;
    answer = memoryNow();
  }
  return answer;
}
}  // namespace

MemoryGuard::MemoryGuard(std::uint64_t mostBytesMore)
{
  const std::lock_guard<std::mutex> lock(mutex);
  rlimit limit = limitWithoutGuards();
  ++guards;
  const rlim_t now = recentMemory();
  if (now == 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, now + mostBytesMore);
  ::setrlimit(RLIMIT_DATA, &limit);
}

MemoryGuard::~MemoryGuard()
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (--guards == 0) ::setrlimit(RLIMIT_DATA, &limitWithoutGuards());
}

bool MemoryGuard::isSafe()
{
  static const bool answer = []
  {
    try
    {
      mrpt::aligned_free(mrpt::aligned_malloc(std::numeric_limits<std::size_t>::max(), 16));
      return false;
    }
    catch (const std::bad_alloc&)
    {
      return true;
    }
  }();
  return answer;
}

}  // namespace quadmap
