#include "records/MemoryGuard.h"

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

TEST(MemoryGuard, AllocationFailsWithAnException) { EXPECT_TRUE(MemoryGuard::isSafe()); }
