#include "AllocationWatch.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
std::atomic<std::size_t>& largestRequest()
{
  static std::atomic<std::size_t> largest{0};
  return largest;
}

void note(std::size_t size)
{
  auto& largest = largestRequest();
  std::size_t before = largest.load();
  while (size > before && !largest.compare_exchange_weak(before, size))
  {
  }
}
}  // namespace

namespace quadmap
{
void AllocationWatch::reset() { largestRequest() = 0; }
std::size_t AllocationWatch::largest() { return largestRequest(); }
}  // namespace quadmap

namespace
{
/** \return Null when it cannot or must not be. */
void* allocate(std::size_t size)
{
  note(size);
  return size > quadmap::kRefusedAllocation ? nullptr : std::malloc(size ? size : 1);
}
}  // namespace

// All forms without alignment, so that whatever one of them gives, each delete may take.
void* operator new(std::size_t size)
{
  if (void* memory = allocate(size)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return ::operator new(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
