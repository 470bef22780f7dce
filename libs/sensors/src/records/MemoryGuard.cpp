#include "records/MemoryGuard.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

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
}  // namespace

MemoryGuard::MemoryGuard()
{
  const rlim_t now = memoryNow();
  if (now == 0 || ::getrlimit(RLIMIT_DATA, &before_) != 0) return;
  rlimit limit = before_;
  limit.rlim_cur = std::min(before_.rlim_cur, now + kMore);
  active_ = ::setrlimit(RLIMIT_DATA, &limit) == 0;
}

MemoryGuard::~MemoryGuard()
{
  if (active_) ::setrlimit(RLIMIT_DATA, &before_);
}

}  // namespace quadmap
