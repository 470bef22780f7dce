#include "quadmap/obs/KeepGreatest.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

using namespace quadmap;

TEST(KeepGreatest, LeavesTheGreatestInTheirOrderAndOfEqualOnesTheFirst)
{
  using Item = std::pair<int, char>;  // a value, and a name
  const std::vector<Item> items{
      {3, 'a'},
      {1, 'b'},
      {2, 'c'},
      {2, 'd'},
      {5, 'e'}
  };
  const auto valueOf = [](const Item& item) { return item.first; };
  auto kept = items;
  EXPECT_EQ(keepGreatest(kept, 3, valueOf), 2u);
  EXPECT_EQ(
      kept, (std::vector<Item>{
                {3, 'a'},
                {2, 'c'},
                {5, 'e'}
  }));
  kept = items;
  EXPECT_EQ(keepGreatest(kept, 5, valueOf), 0u);
  EXPECT_EQ(kept, items);
}
