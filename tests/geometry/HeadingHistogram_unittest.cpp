#include "quadmap/geometry/HeadingHistogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "quadmap/geometry/RotationDistance.h"

namespace quadmap
{
namespace
{
TEST(HeadingHistogram, FindsThePeakBetweenBinsOfFoldedDirections)
{
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.0, 0.06);
  for (const double yaw : {0.001, 0.3217, 0.785, 1.5699})
  {
    HeadingHistogram histogram;
    for (int i = 0; i < 4000; ++i) histogram.add(yaw + (i % 4) * M_PI / 2 + noise(generator), 1.0);
    const auto peak = histogram.peak();
    // 4000 samples of 3.4 degrees leave 0.05 degrees; three of these.
    EXPECT_LT(yawDistance(peak.yaw, yaw), 0.15 * M_PI / 180) << yaw;
    EXPECT_GT(peak.dominance, 0.95);
    EXPECT_NEAR(peak.mass, 4000, 1e-6);
  }
}

TEST(HeadingHistogram, SeesNoDominanceInAnEvenSpread)
{
  HeadingHistogram histogram;
  for (int i = 0; i < 3600; ++i) histogram.add(i * 0.1 * M_PI / 180, 1.0);
  EXPECT_NEAR(histogram.peak().dominance, 20.0 / 90.0, 0.01);
}

TEST(HeadingHistogram, WeighsItsEntries)
{
  HeadingHistogram histogram;
  for (int i = 0; i < 100; ++i)
  {
    histogram.add(0.2, 1.0);
    histogram.add(0.9, 0.4);
  }
  EXPECT_NEAR(histogram.peak().yaw, 0.2, 1e-3);
  EXPECT_NEAR(histogram.peak().dominance, 1.0 / 1.4, 1e-6);
}

TEST(HeadingHistogram, IsEmptyAtFirst) { EXPECT_EQ(HeadingHistogram().peak().mass, 0.0); }

}  // namespace
}  // namespace quadmap
