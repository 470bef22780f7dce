#pragma once

#include <sys/resource.h>

namespace quadmap
{
/** While it lives, the process may take only so much more memory than it has; then allocation
 * fails with an exception. It is for reading objects whose layout is not known here. */
class MemoryGuard
{
 public:
  MemoryGuard();
  ~MemoryGuard();
  MemoryGuard(const MemoryGuard&) = delete;
  MemoryGuard& operator=(const MemoryGuard&) = delete;

 private:
  bool active_ = false;
  rlimit before_{};
};

}  // namespace quadmap
