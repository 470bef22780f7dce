#include "records/MemoryGuard.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <mutex>

namespace quadmap
{
namespace
{
/** More than any stock observation has; the other threads of a run take less in that time. */
constexpr rlim_t kMore = rlim_t{1} << 28;  // [bytes]

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
rlimit limitWithoutGuards{};
}  // namespace

MemoryGuard::MemoryGuard()
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (guards++ == 0) ::getrlimit(RLIMIT_DATA, &limitWithoutGuards);
  const rlim_t now = memoryNow();
  if (now == 0) return;
  rlimit limit = limitWithoutGuards;
  limit.rlim_cur = std::min(limitWithoutGuards.rlim_cur, now + kMore);
  ::setrlimit(RLIMIT_DATA, &limit);
}

MemoryGuard::~MemoryGuard()
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (--guards == 0) ::setrlimit(RLIMIT_DATA, &limitWithoutGuards);
}

}  // namespace quadmap
