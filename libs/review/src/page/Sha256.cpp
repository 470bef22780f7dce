#include "page/Sha256.h"

#include <array>
#include <cstdint>

namespace quadmap
{
namespace
{
using Words = std::array<std::uint32_t, 8>;
using Constants = std::array<std::uint32_t, 64>;

std::uint32_t rotated(std::uint32_t x, unsigned bits) { return (x >> bits) | (x << (32 - bits)); }

/** First 32 bits of the fractional part of a root of a prime: `root` is 2 or 3 (section 4.2.2).
 * The largest whole r with r^root <= prime * 2^(32 root) has them as its lower half. */
std::uint32_t fractionOfRoot(std::uint32_t prime, int root)
{
  using Wide = unsigned __int128;
  std::uint64_t low = 0, high = std::uint64_t{1} << 37;  // the root of 311, times 2^32, is below
  while (low + 1 < high)
  {
    const std::uint64_t middle = (low + high) / 2;
    const Wide square = static_cast<Wide>(middle) * middle;
    // The cube has 111 bits, the prime times 2^96 has 105.
    const bool isBelow = root == 2 ? square <= static_cast<Wide>(prime) << 64
                                   : square * middle <= static_cast<Wide>(prime) << 96;
    (isBelow ? low : high) = middle;
  }
  return static_cast<std::uint32_t>(low);
}

template <std::size_t N>
std::array<std::uint32_t, N> fractionsOfRoots(int root)
{
  std::array<std::uint32_t, N> fractions{};
  std::uint32_t candidate = 2;
  for (std::size_t found = 0; found < N; ++candidate)
  {
    bool isPrime = true;
    for (std::uint32_t d = 2; d * d <= candidate; ++d) isPrime = isPrime && candidate % d != 0;
    if (isPrime) fractions[found++] = fractionOfRoot(candidate, root);
  }
  return fractions;
}

/** Takes one block of 64 bytes into the digest (section 6.2.2). */
void addBlock(const unsigned char* block, Words& digest)
{
  static const Constants kConstants = fractionsOfRoots<64>(3);
  Constants w{};
  for (std::size_t t = 0; t < 16; ++t)
    for (std::size_t i = 0; i < 4; ++i) w[t] = (w[t] << 8) | block[4 * t + i];
  for (std::size_t t = 16; t < 64; ++t)
  {
    const std::uint32_t x = w[t - 15], y = w[t - 2];
    w[t] = w[t - 16] + (rotated(x, 7) ^ rotated(x, 18) ^ (x >> 3)) + w[t - 7] +
           (rotated(y, 17) ^ rotated(y, 19) ^ (y >> 10));
  }
  auto [a, b, c, d, e, f, g, h] = digest;
  for (std::size_t t = 0; t < 64; ++t)
  {
    const std::uint32_t t1 = h + (rotated(e, 6) ^ rotated(e, 11) ^ rotated(e, 25)) +
                             ((e & f) ^ (~e & g)) + kConstants[t] + w[t];
    const std::uint32_t t2 =
        (rotated(a, 2) ^ rotated(a, 13) ^ rotated(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const Words sum = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) digest[i] += sum[i];
}

}  // namespace

std::string sha256(std::string_view bytes)
{
  std::string padded(bytes);
  padded += '\x80';
  padded.append((64 + 56 - padded.size() % 64) % 64, '\0');
  const std::uint64_t bits = 8 * static_cast<std::uint64_t>(bytes.size());
  for (int shift = 56; shift >= 0; shift -= 8) padded += static_cast<char>((bits >> shift) & 0xFF);

  Words digest = fractionsOfRoots<8>(2);
  for (std::size_t i = 0; i < padded.size(); i += 64)
    addBlock(reinterpret_cast<const unsigned char*>(&padded[i]), digest);
  std::string out;
  for (const std::uint32_t word : digest)
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((word >> shift) & 0xFF);
  return out;
}

}  // namespace quadmap
