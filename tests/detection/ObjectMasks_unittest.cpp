#include "ObjectMasks.h"

#include <gtest/gtest.h>

#include "HandMadeTensor.h"

using namespace quadmap;

namespace
{
constexpr int kSide = 16;  // of the prototypes; the input has 64 pixels

/** Prototype 0 is positive in a rectangle of its pixels, prototype 1 is 1 everywhere. */
HandMadeTensor prototypes(int x1, int y1, int x2, int y2)
{
  HandMadeTensor tensor({2, kSide, kSide}, -1);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
    {
      if (x >= x1 && x < x2 && y >= y1 && y < y2)
        tensor.numbers[static_cast<std::size_t>(y * kSide + x)] = 1;
      tensor.numbers[static_cast<std::size_t>((kSide + y) * kSide + x)] = 1;
    }
  return tensor;
}

/** Pixels of the mask, and the corners of what it covers in the image. */
struct Covered
{
  unsigned count = 0, x1 = ~0u, y1 = ~0u, x2 = 0, y2 = 0;
};
Covered coveredBy(const ObjectMask& mask)
{
  Covered c;
  for (unsigned y = 0; y < 200; ++y)
    for (unsigned x = 0; x < 200; ++x)
      if (mask.contains(x, y))
        c = {
            c.count + 1, std::min(c.x1, x), std::min(c.y1, y), std::max(c.x2, x),
            std::max(c.y2, y)};
  return c;
}
}  // namespace

TEST(ObjectMasks, CoverWhatThePrototypesShowAtTheImagesSize)
{
  // The image fills the input's rows 16 to 48, magnified twice: input (x, y) is image
  // (2 x, 2 (y - 16)). The prototype's pixels 4 to 8 are the input's 16 to 32.
  const auto tensor = prototypes(4, 6, 8, 10);
  const auto place = Placement::of({128, 64}, {64, 64}, Fit::Centre);
  const auto mask = objectMask(
      tensor.tensor(),
      {
          {},
          0, 1, { 2,0}
  },
      {10, 2, 100, 60}, place, {64, 64});
  ASSERT_TRUE(mask);
  const Covered c = coveredBy(*mask);
  EXPECT_EQ(c.x1, 32u);
  EXPECT_EQ(c.x2, 63u);
  EXPECT_EQ(c.y1, 16u);  // the input's rows 24 to 40
  EXPECT_EQ(c.y2, 47u);
  EXPECT_NEAR(c.count, 32 * 32, 32 * 32 / 20) << "corners are rounded by the interpolation";
}

TEST(ObjectMasks, EndAtTheBox)
{
  const auto tensor = prototypes(0, 0, kSide, kSide);
  const auto place = Placement::of({64, 64}, {64, 64}, Fit::Centre);
  const auto mask = objectMask(
      tensor.tensor(),
      {
          {},
          0, 1, { 1,0}
  },
      {10.4, 20, 30.6, 63}, place, {64, 64});
  ASSERT_TRUE(mask);
  const Covered c = coveredBy(*mask);
  EXPECT_EQ(c.x1, 11u);
  EXPECT_EQ(c.x2, 30u);
  EXPECT_EQ(c.y1, 20u);
  EXPECT_EQ(c.y2, 63u);
}

TEST(ObjectMasks, AddUpThePrototypes)
{
  const auto tensor = prototypes(4, 4, 8, 8);
  const auto place = Placement::of({64, 64}, {64, 64}, Fit::Centre);
  const ImageBox box{0, 0, 63, 63};
  const auto count = [&](float a, float b)
  {
    const auto mask = objectMask(
        tensor.tensor(),
        {
            {},
            0, 1, { a,b}
    },
        box, place, {64, 64});
    return mask ? coveredBy(*mask).count : 0;
  };
  EXPECT_EQ(count(1, 2), 64u * 64u);
  EXPECT_EQ(count(1, -2), 0u) << "no mask";
  EXPECT_GT(count(-1, 0), 60u * 60u) << "all around";
}
