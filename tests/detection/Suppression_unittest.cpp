#include "Suppression.h"

#include <gtest/gtest.h>

using namespace quadmap;

namespace
{
RawBox rawBox(double x, float score, std::size_t label = 0)
{
  return {
      {x, 0, x + 10, 10},
      label, score, {   }
  };
}
std::vector<double> lefts(const std::vector<RawBox>& rawBoxes)
{
  std::vector<double> xs;
  for (const auto& c : rawBoxes) xs.push_back(c.box.x1);
  return xs;
}
}  // namespace

TEST(Suppression, KeepsTheSurestOfThoseThatOverlap)
{
  // Shifted by 2 of 10 pixels, boxes overlap by 8 / 12; by 4, 6 / 14; by 6, 4 / 16.
  const auto kept = suppressOverlaps(
      {rawBox(2, 0.5f), rawBox(0, 0.4f), rawBox(6, 0.45f), rawBox(4, 0.9f)}, 0.5, 10);
  EXPECT_EQ(lefts(kept), (std::vector<double>{4, 0}));
}

TEST(Suppression, LooksAtBoxesOfOneLabel)
{
  const auto kept =
      suppressOverlaps({rawBox(0, 0.5f), rawBox(0, 0.4f, 1), rawBox(0, 0.3f)}, 0.5, 10);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[1].label, 1u);
}

TEST(Suppression, AllowsAsMuchOverlapAsAsked)
{
  const std::vector<RawBox> two{rawBox(0, 0.5f), rawBox(2, 0.4f)};  // IoU 2/3
  EXPECT_EQ(suppressOverlaps(two, 0.67, 10).size(), 2u);
  EXPECT_EQ(suppressOverlaps(two, 0.66, 10).size(), 1u);
}

TEST(Suppression, KeepsTheOrderOfEqualScoresAndAtMostSoMany)
{
  const auto kept = suppressOverlaps(
      {rawBox(40, 0.5f), rawBox(0, 0.5f), rawBox(20, 0.6f), rawBox(60, 0.1f)}, 0.5, 3);
  EXPECT_EQ(lefts(kept), (std::vector<double>{20, 40, 0}));
}
