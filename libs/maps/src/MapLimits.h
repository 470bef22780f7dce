#pragma once

#include <cstdint>

namespace quadmap
{
/** More than this in a file is garbage, not a map; and no map with more is written. */
constexpr std::uint32_t kMostStoredObjects = 100000;
/** What a file may hold uncompressed [bytes]: so many objects, of 1 kB each when few detectors
 * disagree about their labels, and the label table. */
constexpr std::uint64_t kMostStoredBytes = std::uint64_t{1} << 27;

}  // namespace quadmap
