#include "cuboid/HeadingByLines.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

namespace
{
constexpr double kDegree = M_PI / 180;

/** A thing whose sides have these directions [rad] of their normals, modulo 90 degrees, and all the
 * same variance: the line of a side is turned against the heading as it is. */
SideLine sidesAt(const std::vector<double>& yaws, double variance)
{
  return [=](double heading) -> std::optional<LineFit>
  {
    const auto side = static_cast<std::size_t>(std::lround(heading / (M_PI / 2)));
    if (side >= yaws.size()) return {};
    const double ahead = yaws[side] + static_cast<double>(side) * M_PI / 2 - heading;
    return LineFit{-ahead, variance, 1.0};
  };
}

}  // namespace

TEST(HeadingByLines, IsTheMeanOfTheSides)
{
  const double variance = kDegree * kDegree;
  const auto heading = headingByLines(0, sidesAt({2 * kDegree, 4 * kDegree}, variance));
  ASSERT_TRUE(heading);
  EXPECT_NEAR(heading->yaw, 3 * kDegree, 1e-12);
  const double one = variance + kHeadingFloor * kHeadingFloor;
  const double chi2 = 2 * kDegree * kDegree / one;  // each side is one degree off
  EXPECT_GT(chi2, 1);
  EXPECT_NEAR(heading->variance, chi2 * one / 2, 1e-12) << "they contradict each other";
}

TEST(HeadingByLines, SidesThatAgreeKnowMoreTogether)
{
  const auto one = headingByLines(0, sidesAt({kDegree}, 1e-4));
  const auto four = headingByLines(0, sidesAt({kDegree, kDegree, kDegree, kDegree}, 1e-4));
  ASSERT_TRUE(one && four);
  EXPECT_NEAR(four->variance, one->variance / 4, 1e-12);
}

TEST(HeadingByLines, KnowsNoSideFartherThanTenDegrees)
{
  EXPECT_FALSE(headingByLines(0, sidesAt({11 * kDegree}, 1e-4)));
  EXPECT_FALSE(headingByLines(0, sidesAt({}, 1e-4)));
  const auto heading = headingByLines(0, sidesAt({5 * kDegree, 20 * kDegree}, 1e-4));
  ASSERT_TRUE(heading);
  EXPECT_NEAR(heading->yaw, 5 * kDegree, 1e-12);
}

TEST(HeadingByLines, WhatDoesNotSettleIsLessCertain)
{
  // The line moves on with the heading: it is not that of a side.
  const SideLine follows = [](double heading) -> std::optional<LineFit>
  {
    if (heading > M_PI / 4) return {};
    return LineFit{-3 * kDegree, 1e-6, 1.0};
  };
  const auto heading = headingByLines(0, follows);
  ASSERT_TRUE(heading);
  EXPECT_NEAR(heading->yaw, 6 * kDegree, 1e-12);
  EXPECT_GT(heading->variance, 9 * kDegree * kDegree);
}
