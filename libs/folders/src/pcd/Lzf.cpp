#include "pcd/Lzf.h"

namespace quadmap
{
std::optional<std::vector<std::uint8_t>> unpackedLzf(
    const std::uint8_t* bytes, std::size_t packedSize, std::size_t size)
{
  constexpr unsigned kLiterals = 32;   // smaller controls are numbers of literal bytes, less one
  constexpr unsigned kLongLength = 7;  // with this length another byte of it follows
  constexpr std::size_t kMostPerByte = 88;  // 264 bytes from the 3 of a longest copy
  if (size / kMostPerByte > packedSize) return std::nullopt;
  std::vector<std::uint8_t> out;
  out.reserve(size);
  for (std::size_t at = 0; at < packedSize;)
  {
    const unsigned control = bytes[at++];
    if (control < kLiterals)
    {
      const std::size_t length = control + 1;
      if (at + length > packedSize || out.size() + length > size) return std::nullopt;
      out.insert(out.end(), bytes + at, bytes + at + length);
      at += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (at + (length == kLongLength ? 2 : 1) > packedSize) return std::nullopt;
    if (length == kLongLength) length += bytes[at++];
    length += 2;
    const std::size_t back = ((control & 0x1F) << 8) + bytes[at++] + 1;
    if (back > out.size() || out.size() + length > size) return std::nullopt;
    // The copy may reach into what it adds itself, hence byte by byte.
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - back]);
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace quadmap
