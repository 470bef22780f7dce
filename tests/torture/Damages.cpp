#include "Damages.h"

#include <cctype>
#include <stdexcept>

#include "quadmap/base/GzipStream.h"

namespace quadmap::torture
{
namespace
{
/** Evenly spaced places, which do not fall on the same field of each of many equal records. */
std::vector<std::size_t> placesIn(const std::string& whole, int count)
{
  std::vector<std::size_t> places;
  for (int i = 0; i < count; ++i)
    places.push_back((2 * static_cast<std::size_t>(i) + 1) * whole.size() / (2 * count));
  return places;
}
}  // namespace

std::string littleEndian(std::uint32_t number)
{
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i));
  return bytes;
}

std::string gzipped(const std::string& bytes)
{
  const auto member = gzipMember({bytes.begin(), bytes.end()}, 6);
  return {member.begin(), member.end()};
}

std::string object(const std::string& name, int version, const std::string& content)
{
  return std::string(1, static_cast<char>(0x80 | name.size())) + name + static_cast<char>(version) +
         content + '\x88';
}

std::string with(const std::string& whole, const std::string& part, const std::string& other)
{
  const auto at = whole.find(part);
  if (at == std::string::npos) throw std::logic_error("the part to replace is not there: " + part);
  return whole.substr(0, at) + other + whole.substr(at + part.size());
}

Cases cuts(const std::string& whole, int count)
{
  Cases cases;
  auto places = placesIn(whole, count);
  places.insert(places.end(), {0, 1, whole.size() - 9, whole.size() - 1});
  for (const auto at : places)
    cases.push_back({"cut to " + std::to_string(at) + " bytes", whole.substr(0, at)});
  return cases;
}

Cases flips(const std::string& whole, int count)
{
  Cases cases;
  int bit = 0;
  for (const auto at : placesIn(whole, count))
  {
    std::string bytes = whole;
    bit = (bit + 3) % 8;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
    cases.push_back({"bit " + std::to_string(bit) + " of byte " + std::to_string(at), bytes});
  }
  return cases;
}

Cases hugeNumbers(const std::string& whole, int count)
{
  Cases cases;
  const std::uint32_t numbers[] = {0xffffffff, 0x7fffffff, 0x10000000, 0x00100000};
  std::size_t next = 0;
  for (const auto at : placesIn(whole, count))
  {
    const std::uint32_t number = numbers[next++ % 4];
    std::string bytes = whole;
    bytes.replace(at, 4, littleEndian(number));
    cases.push_back({std::to_string(number) + " at byte " + std::to_string(at), bytes});
  }
  return cases;
}

Cases wrongWords(const std::string& whole, int count)
{
  const std::string words[] = {"nan",         "-1e300", "1e999", "99999999999999999999",
                               "\x1b[31mred", "",       "../..", std::string(100000, '9')};
  Cases cases;
  std::size_t next = 0;
  for (auto at : placesIn(whole, count))
  {
    const auto isSpace = [&](std::size_t i)
    { return std::isspace(static_cast<unsigned char>(whole[i])) != 0; };
    while (at > 0 && !isSpace(at - 1)) --at;
    std::size_t end = at;
    while (end < whole.size() && !isSpace(end)) ++end;
    const std::string& word = words[next++ % std::size(words)];
    cases.push_back(
        {"'" + word.substr(0, 20) + "' at byte " + std::to_string(at),
         whole.substr(0, at) + word + whole.substr(end)});
  }
  return cases;
}

Cases compressed(Cases cases)
{
  for (auto& c : cases)
  {
    c.name += ", then compressed";
    c.bytes = gzipped(c.bytes);
  }
  return cases;
}

Cases at(const std::string& place, Cases cases)
{
  for (auto& c : cases) c.place = place;
  return cases;
}

Cases operator+(Cases a, const Cases& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace quadmap::torture
