#include "quadmap/obs/LabelColor.h"

#include <array>
#include <cstdint>

namespace quadmap
{
namespace
{
using mrpt::img::TColor;

/** Colours that are easily told apart and dark enough for text on white. */
const std::array<TColor, 14> kPalette = {
    TColor(0x0b, 0x7a, 0x62), TColor(0x1f, 0x77, 0xb4), TColor(0x2c, 0x94, 0x2c),
    TColor(0xd6, 0x4f, 0xa6), TColor(0xc0, 0x8a, 0x1a), TColor(0xe0, 0x6c, 0x00),
    TColor(0x8a, 0x56, 0xc2), TColor(0x5f, 0x6b, 0x7a), TColor(0xd0, 0x27, 0x28),
    TColor(0x0f, 0x9f, 0xb0), TColor(0x3b, 0x3f, 0xb6), TColor(0x8c, 0x56, 0x4b),
    TColor(0xb0, 0x12, 0x5b), TColor(0x9c, 0x9a, 0x12)};

/** Hash FNV-1a. Its start value gives the fourteen usual indoor labels different colours. */
std::uint32_t hash(const std::string& text)
{
  constexpr std::uint32_t kBasis = 93158u;
  constexpr std::uint32_t kPrime = 16777619u;
  std::uint32_t h = kBasis;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * kPrime;
  return h ^ (h >> 15);
}

}  // namespace

TColor labelColor(const std::string& label, std::uint8_t alpha)
{
  TColor color = kPalette[hash(label) % kPalette.size()];
  color.A = alpha;
  return color;
}

}  // namespace quadmap
