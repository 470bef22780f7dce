#include "Mutator.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace quadmap
{
namespace
{
template <typename T>
std::string bytesOf(T value)
{
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

/** Values that sit at the borders of what programs check. */
const std::vector<std::string>& binaryValues()
{
  static const std::vector<std::string> values = {
      bytesOf<std::uint8_t>(0xff),
      bytesOf<std::uint8_t>(0x7f),
      bytesOf<std::uint8_t>(0x80),
      bytesOf<std::uint32_t>(0xffffffff),
      bytesOf<std::uint32_t>(0x7fffffff),
      bytesOf<std::uint32_t>(0x80000000),
      bytesOf<std::uint32_t>(0x00ffffff),
      bytesOf<std::uint32_t>(65537),
      bytesOf<std::uint32_t>(0),
      bytesOf(std::numeric_limits<double>::quiet_NaN()),
      bytesOf(std::numeric_limits<double>::infinity()),
      bytesOf(-std::numeric_limits<double>::max()),
      bytesOf(std::numeric_limits<double>::denorm_min()),
      bytesOf(-1.0)};
  return values;
}
}  // namespace

std::string Mutator::mutate(std::string bytes)
{
  for (std::size_t n = 1 + below(4); n > 0; --n) damage(bytes);
  return bytes;
}

void Mutator::overwrite(std::string& bytes, const std::string& value)
{
  const std::size_t at = below(bytes.size());
  bytes.replace(at, std::min(value.size(), bytes.size() - at), value);
}

void Mutator::damage(std::string& bytes)
{
  if (bytes.empty()) bytes = "x";
  const std::size_t at = below(bytes.size());
  const std::size_t length = 1 + below(std::min<std::size_t>(64, bytes.size() - at));
  switch (below(9))
  {
    case 0:  // one bit
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:  // one byte
      bytes[at] = static_cast<char>(random_());
      break;
    case 2:
    case 3:
      overwrite(bytes, binaryValues()[below(binaryValues().size())]);
      break;
    case 4:  // cut off
      bytes.resize(at);
      break;
    case 5:  // lost in the middle
      bytes.erase(at, length);
      break;
    case 6:  // stands there twice
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 7:
      bytes.insert(at, dictionary[below(dictionary.size())]);
      break;
    default:
      overwrite(bytes, dictionary[below(dictionary.size())]);
  }
}

}  // namespace quadmap
