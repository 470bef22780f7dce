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

void* operator new(std::size_t size)
{
  note(size);
  void* memory = size > quadmap::kRefusedAllocation ? nullptr : std::malloc(size ? size : 1);
  if (!memory) throw std::bad_alloc();
  return memory;
}
void* operator new[](std::size_t size) { return ::operator new(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
