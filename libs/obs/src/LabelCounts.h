#pragma once

#include <cstddef>
#include <cstdint>

namespace quadmap
{
/** More than this in a label table is garbage. They hold for text and for archives, so that every
 * table that was read can be stored. */
constexpr std::uint32_t kMaxClasses = 10000;
constexpr std::uint32_t kMaxConfused = 100;      // labels one label is confused with
constexpr std::uint32_t kMaxSpellings = 100000;  // of all labels together
constexpr std::size_t kLongestLabel = 1000;      // [bytes]

}  // namespace quadmap
