#include <mrpt/core/aligned_allocator.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

/** The memory of MRPT's vectors and matrices. MRPT's own aligned_malloc() returns null where there
 * is none left, and its allocator passes that on, though a container may only get memory or an
 * exception: it writes to the null pointer then, and one edited count in a file ends the program.
 * These take the place of MRPT's functions in programs that are linked with this library (see its
 * CMakeLists.txt). They obtain and free memory as those do, so that either can free what the other
 * gave. */
namespace mrpt
{
void* aligned_malloc(std::size_t size, std::size_t alignment)
{
  if (size > PTRDIFF_MAX) throw std::bad_alloc();  // what it is rounded up to might be none
  const std::size_t step = alignment > 0 ? alignment : 1;
  void* memory = std::aligned_alloc(alignment, (size + step - 1) / step * step);
  if (!memory && size > 0) throw std::bad_alloc();
  return memory;
}

void* aligned_calloc(std::size_t size, std::size_t alignment)
{
  void* memory = aligned_malloc(size, alignment);
  if (size > 0) std::memset(memory, 0, size);
  return memory;
}

void aligned_free(void* memory) { std::free(memory); }
}  // namespace mrpt
