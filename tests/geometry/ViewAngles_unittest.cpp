#include "quadmap/geometry/ViewAngles.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

TEST(Parallax, IsTheLargestAngleBetweenTwoRays)
{
  const Eigen::Vector3d point(1, 2, 3);
  std::vector<Eigen::Vector3d> cameras;
  EXPECT_EQ(parallax(point, cameras), 0);
  for (const double angle : {0.2, 0.9, -0.4})
    cameras.emplace_back(point + 2 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
  EXPECT_NEAR(parallax(point, cameras), 1.3, 1e-12);
  EXPECT_NEAR(parallax(point, {cameras[0], cameras[0]}), 0, 1e-6);
}

TEST(RangeThatFills, IsWhereTheSizeReachesFromPlaneToPlane)
{
  const double range = 3.0, size = 0.8, half = std::atan(0.5 * size / range);
  const Eigen::Vector3d left(std::cos(half), 0, std::sin(half)),
      right(-std::cos(half), 0, std::sin(half));
  EXPECT_NEAR(rangeThatFills(size, left, right), range, 1e-12);
  EXPECT_TRUE(std::isfinite(rangeThatFills(size, left, -left))) << "a box without width";
}
