#include <gtest/gtest.h>

#include <algorithm>

#include "Coverage.h"
#include "Fuzz.h"

using namespace quadmap;

namespace
{
constexpr std::size_t kStairs = 16;

/** How many bytes at the start are odd and even by turns. Each step is a branch of its own. */
template <std::size_t step = 0>
std::size_t climbed(const std::string& bytes)
{
  if constexpr (step < kStairs)
    if (step < bytes.size() && (bytes[step] & 1) == (step % 2 ? 0 : 1))
      return climbed<step + 1>(bytes);
  volatile std::size_t here = step;  // keeps the branches apart
  return here;
}
}  // namespace

TEST(Coverage, LeadsUpAStaircaseStepByStep)
{
  const std::string valid(kStairs, '.');  // an even byte
  Coverage::reset();
  climbed(valid);
  if (!Coverage::foundNew()) GTEST_SKIP() << "this program does not count what ran";
  FuzzRun run;
  run.count = 10000;
  run.mostlyHarmless = true;
  std::size_t highest = 0;
  fuzz(valid, run, [&](const std::string& bytes) { highest = std::max(highest, climbed(bytes)); });
  EXPECT_EQ(highest, kStairs) << "blind damage hits few places at once";
}
