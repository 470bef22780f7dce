#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace quadmap
{
/** Unpacks bytes in the format of LZF, which compressed PCD files have: runs of literal bytes, and
 * copies of what was unpacked before.
 * \param size Of the result; nothing is returned when the data give another one. */
std::optional<std::vector<std::uint8_t>> unpackedLzf(
    const std::uint8_t* bytes, std::size_t packedSize, std::size_t size);

}  // namespace quadmap
