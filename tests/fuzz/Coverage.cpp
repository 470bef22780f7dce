#include "Coverage.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace
{
/** The counters of one library or program: one byte for each edge of its control flow. */
struct Counters
{
  std::uint8_t* first;
  std::vector<std::uint8_t> seen;  // of each, a bit for each order of magnitude that was found
};

std::vector<Counters>& allCounters()
{
  static std::vector<Counters> all;
  return all;
}

/** One bit for 1, 2 to 3, 4 to 7 and so on: how often a loop ran matters less than that it ran. */
std::uint8_t magnitudeBit(std::uint8_t count)
{
  std::uint8_t bit = 1;
  for (; count > 1; count = static_cast<std::uint8_t>(count >> 1))
    bit = static_cast<std::uint8_t>(bit << 1);
  return bit;
}

/** The first counter that is not zero, or the end. Few are, hence the large steps. */
const std::uint8_t* firstOther(const std::uint8_t* from, const std::uint8_t* end)
{
  static constexpr std::uint8_t kZeros[128] = {};
  constexpr std::ptrdiff_t kStep = sizeof kZeros;
  while (end - from >= kStep && std::memcmp(from, kZeros, sizeof kZeros) == 0) from += kStep;
  while (from != end && *from == 0) ++from;
  return from;
}
}  // namespace

/** Called by each library and program that was compiled with
 * -fsanitize-coverage=inline-8bit-counters when it is loaded. */
extern "C" void __sanitizer_cov_8bit_counters_init(std::uint8_t* first, std::uint8_t* end)
{
  for (const auto& counters : allCounters())
    if (counters.first == first) return;
  allCounters().push_back(
      {first, std::vector<std::uint8_t>(static_cast<std::size_t>(end - first))});
}

namespace quadmap
{
void Coverage::reset()
{
  for (auto& counters : allCounters()) std::memset(counters.first, 0, counters.seen.size());
}

bool Coverage::foundNew()
{
  bool isNew = false;
  for (auto& counters : allCounters())
  {
    const std::uint8_t* const end = counters.first + counters.seen.size();
    for (const auto* i = firstOther(counters.first, end); i != end; i = firstOther(i + 1, end))
    {
      std::uint8_t& seen = counters.seen[static_cast<std::size_t>(i - counters.first)];
      const std::uint8_t bit = magnitudeBit(*i);
      isNew = isNew || !(seen & bit);
      seen |= bit;
    }
  }
  return isNew;
}
}  // namespace quadmap
