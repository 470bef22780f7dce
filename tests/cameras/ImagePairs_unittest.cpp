#include "ImagePairs.h"

#include <gtest/gtest.h>

#include "FakeDevice.h"

using namespace quadmap;

namespace
{
DeviceImage depth(int number, double time)
{
  return fakeImage(DeviceImage::Kind::Depth, number, time);
}
DeviceImage color(int number, double time)
{
  return fakeImage(DeviceImage::Kind::Color, number, time);
}
}  // namespace

TEST(ImagePairs, PairsImagesOfOneTimeInAnyOrder)
{
  ImagePairs pairs(0.01);
  EXPECT_FALSE(pairs.add(depth(1, 0.0)));
  auto pair = pairs.add(color(1, 0.009));
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->depth.number, 1);
  EXPECT_FALSE(pairs.add(color(2, 0.033)));
  pair = pairs.add(depth(2, 0.030));
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->depth.number, 2);
  EXPECT_EQ(pair->color.number, 2);
  EXPECT_EQ(pairs.unpaired() + pairs.lost(), 0u);
}

TEST(ImagePairs, PairsNothingThatIsTooFarApart)
{
  ImagePairs pairs(0.01);
  EXPECT_FALSE(pairs.add(depth(1, 0.0)));
  EXPECT_FALSE(pairs.add(color(1, 0.011)));
  const auto pair = pairs.add(depth(2, 0.012));
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->depth.number, 2);
  EXPECT_EQ(pairs.unpaired(), 1u);
}

TEST(ImagePairs, CountsWhatNeverCame)
{
  ImagePairs pairs(0.01);
  for (const int number : {5, 6, 9, 1, 2})  // two are lost, and the camera starts anew
  {
    pairs.add(depth(number, number));
    EXPECT_TRUE(pairs.add(color(number, number)));
  }
  EXPECT_EQ(pairs.lost(), 2u);
  EXPECT_EQ(pairs.unpaired(), 0u);
}
