#pragma once

namespace quadmap
{
/** While it lives, the process may take only so much more memory than it has; then allocation
 * fails with an exception. It is for reading objects whose layout is not known here. Several may
 * live at once, in any threads: the limit of the process goes with the last one. */
class MemoryGuard
{
 public:
  MemoryGuard();
  ~MemoryGuard();
  MemoryGuard(const MemoryGuard&) = delete;
  MemoryGuard& operator=(const MemoryGuard&) = delete;

  /** Whether allocation really fails with an exception in this program: MRPT's own allocator gives
   * a null pointer instead. quadmap's takes its place, except where a program loads MRPT's core
   * library before those of quadmap. */
  static bool isSafe();
};

}  // namespace quadmap
