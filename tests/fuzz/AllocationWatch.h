#pragma once

#include <cstddef>

namespace quadmap
{
/** Watches operator new of the whole process, libraries included. */
struct AllocationWatch
{
  static void reset();
  /** The largest single request since reset() [bytes]. */
  static std::size_t largest();
};

/** A request beyond this throws std::bad_alloc instead of filling the machine's memory. */
constexpr std::size_t kRefusedAllocation = std::size_t{1} << 30;

}  // namespace quadmap
