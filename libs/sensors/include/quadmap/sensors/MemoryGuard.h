#pragma once

#include <cstdint>

namespace quadmap
{
/** While it lives, the process may take only so much more memory than it has; then allocation
 * fails with an exception. It is for readers of others, which take whatever a file states. Several
 * may live at once, in any threads: the limit is that of the one that was made last, and goes with
 * the last one. Then the process has the limit again that it had before the first of all. */
class MemoryGuard
{
 public:
  /** More than any stock observation of MRPT has; the other threads of a run take less in that time
   * [bytes]. */
  static constexpr std::uint64_t kForObservations = std::uint64_t{1} << 28;

  explicit MemoryGuard(std::uint64_t mostBytesMore = kForObservations);
  ~MemoryGuard();
  MemoryGuard(const MemoryGuard&) = delete;
  MemoryGuard& operator=(const MemoryGuard&) = delete;

  /** Whether allocation really fails with an exception in this program: MRPT's own allocator gives
   * a null pointer instead. quadmap's takes its place, except where a program loads MRPT's core
   * library before those of quadmap. */
  static bool isSafe();
};

}  // namespace quadmap
