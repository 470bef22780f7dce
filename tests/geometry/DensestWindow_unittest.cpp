#include "quadmap/geometry/DensestWindow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace quadmap;

TEST(DensestWindow, IsThatOfAllPairsOfEnds)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 10);
  for (int trial = 0; trial < 50; ++trial)
  {
    std::vector<double> values(40);
    for (double& v : values) v = uniform(random);
    std::sort(values.begin(), values.end());
    std::size_t most = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      for (std::size_t j = i; j < values.size(); ++j)
        if (values[j] - values[i] <= 1.5) most = std::max(most, j + 1 - i);
    const Window window = densestWindow(values, 1.5);
    EXPECT_EQ(window.count, most);
    EXPECT_LE(values[window.first + window.count - 1] - values[window.first], 1.5);
  }
}

TEST(DensestWindow, TheLowestOfEquallyDenseOnesIsChosen)
{
  const Window window = densestWindow({1.0, 1.1, 1.2, 5.0, 5.1, 5.2}, 0.5);
  EXPECT_EQ(window.first, 0u);
  EXPECT_EQ(window.count, 3u);
  EXPECT_EQ(window.middle(), 1u);
}

TEST(DensestWindow, EndsAreIncludedAndNothingHoldsNothing)
{
  EXPECT_EQ(densestWindow({0.0, 1.0}, 1.0).count, 2u);
  EXPECT_EQ(densestWindow({0.0, 0.0, 1.0}, 0.0).count, 2u);
  EXPECT_EQ(densestWindow({}, 1.0).count, 0u);
}
