#include "quadmap/geometry/ImageBox.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "RandomGeometry.h"

using namespace quadmap;

TEST(ImageBox, IsValidOnlyWithFinitePositiveSizes)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE((ImageBox{1, 2, 3, 4}).isValid());
  EXPECT_TRUE((ImageBox{-10, -10, -5, -5}).isValid());
  for (const ImageBox& bad : {
           ImageBox{   },
           ImageBox{    1,   2,   1, 4},
           ImageBox{    1,   2,   3, 2},
           ImageBox{    3,   2,   1, 4},
           ImageBox{    1,   4,   3, 2},
           ImageBox{  nan,   0,   1, 1},
           ImageBox{    0, nan,   1, 1},
           ImageBox{    0,   0, nan, 1},
           ImageBox{    0,     0,   1, nan},
           ImageBox{    0,   0, inf, 1},
           ImageBox{ -inf,   0,   1, 1}
  })
  {
    EXPECT_FALSE(bad.isValid()) << bad.x1 << " " << bad.y1 << " " << bad.x2 << " " << bad.y2;
    EXPECT_EQ(bad.area(), 0);
    EXPECT_FALSE(bad.clipped(640, 480).isValid());
  }
}

TEST(ImageBox, ClipsToThePixelCentresOfTheImage)
{
  const ImageBox clipped = ImageBox{-5, 10, 700, 900}.clipped(640, 480);
  EXPECT_EQ(clipped.x1, 0);
  EXPECT_EQ(clipped.y1, 10);
  EXPECT_EQ(clipped.x2, 639);
  EXPECT_EQ(clipped.y2, 479);
}

TEST(ImageBox, OutsideTheImageNothingIsLeft)
{
  for (const ImageBox& outside : {
           ImageBox{-20,  10, -10,  20},
           ImageBox{650,  10, 660,  20},
           ImageBox{ 10, -20,  20, -10},
           ImageBox{ 10, 480,  20, 500}
  })
    EXPECT_FALSE(outside.clipped(640, 480).isValid()) << outside.x1 << " " << outside.y1;
  EXPECT_FALSE((ImageBox{0, 0, 10, 10}).clipped(0, 0).isValid());
}

TEST(ImageBoxIoU, CountsTheSharedCellsOfRandomIntegerBoxes)
{
  test::RandomGeometry random(5);
  const auto coordinate = [&] { return std::floor(random.uniform(0, 30)); };
  for (int trial = 0; trial < 200; ++trial)
  {
    const double ax = coordinate(), ay = coordinate(), bx = coordinate(), by = coordinate();
    const ImageBox a{ax, ay, ax + 1 + coordinate(), ay + 1 + coordinate()};
    const ImageBox b{bx, by, bx + 1 + coordinate(), by + 1 + coordinate()};
    int common = 0, either = 0;
    for (int x = 0; x < 70; ++x)
      for (int y = 0; y < 70; ++y)
      {
        const bool inA = x >= a.x1 && x < a.x2 && y >= a.y1 && y < a.y2;
        const bool inB = x >= b.x1 && x < b.x2 && y >= b.y1 && y < b.y2;
        common += inA && inB;
        either += inA || inB;
      }
    EXPECT_NEAR(imageBoxIoU(a, b), double(common) / either, 1e-12);
    EXPECT_EQ(imageBoxIoU(a, b), imageBoxIoU(b, a));
  }
}

TEST(ImageBoxIoU, IsOneForEqualAndZeroForTouchingOrInvalidBoxes)
{
  const ImageBox box{1.5, 2.5, 30, 40};
  EXPECT_DOUBLE_EQ(imageBoxIoU(box, box), 1);
  EXPECT_EQ(imageBoxIoU(box, {30, 2.5, 50, 40}), 0);
  EXPECT_EQ(imageBoxIoU(box, {40, 30, 1, 2}), 0);
  EXPECT_EQ(imageBoxIoU({}, {}), 0);
}
