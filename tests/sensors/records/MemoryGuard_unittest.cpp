#include "quadmap/sensors/MemoryGuard.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <optional>

using namespace quadmap;

namespace
{
rlim_t limitNow()
{
  rlimit limit{};
  EXPECT_EQ(::getrlimit(RLIMIT_DATA, &limit), 0);
  return limit.rlim_cur;
}
}  // namespace

TEST(MemoryGuard, TheLimitGoesWithTheLastOne)
{
  const rlim_t before = limitNow();
  std::optional<MemoryGuard> first, second;
  first.emplace();
  EXPECT_LT(limitNow(), before);
  second.emplace();
  first.reset();
  EXPECT_LT(limitNow(), before) << "the second one still lives";
  second.reset();
  EXPECT_EQ(limitNow(), before);
}

TEST(MemoryGuard, TheLimitIsWhatWasAskedFor)
{
  std::optional<MemoryGuard> guard;
  guard.emplace(std::uint64_t{1} << 30);
  const rlim_t most = limitNow();
  guard.reset();
  guard.emplace(std::uint64_t{1} << 20);
  EXPECT_LT(limitNow() + (rlim_t{1} << 29), most);
}

TEST(MemoryGuard, AllocationFailsWithAnException) { EXPECT_TRUE(MemoryGuard::isSafe()); }
