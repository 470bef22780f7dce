#include "quadmap/geometry/ConvexHull.h"

#include <gtest/gtest.h>

#include "RandomGeometry.h"

using namespace quadmap;
using namespace quadmap::test;

TEST(ConvexHull, ContainsAllPointsAndTurnsLeftAtEachCorner)
{
  RandomGeometry random(51);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 200; ++i) points.emplace_back(random.uniform(-1, 1), random.uniform(-2, 2));
  const auto hull = convexHull(points);
  ASSERT_GE(hull.size(), 3u);
  for (std::size_t i = 0; i < hull.size(); ++i)
  {
    const Eigen::Vector2d& a = hull[i];
    const Eigen::Vector2d &b = hull[(i + 1) % hull.size()], &c = hull[(i + 2) % hull.size()];
    EXPECT_GT(cross(b - a, c - b), 0);
    for (const auto& p : points) EXPECT_GE(cross(b - a, p - a), -1e-12);
  }
}

TEST(ConvexHull, HasNoCornersOnItsSidesAndNoneTwice)
{
  const auto hull = convexHull({
      {0,   0},
      {1,   0},
      {2,   0},
      {2,   1},
      {2,   1},
      {0,   1},
      {1, 0.5}
  });
  EXPECT_EQ(hull.size(), 4u);
}

TEST(ConvexHull, OfOnePlaceIsThisPlaceAndOfALineItsEnds)
{
  using Points = std::vector<Eigen::Vector2d>;
  EXPECT_EQ(convexHull(Points{Eigen::Vector2d(3, 4)}).size(), 1u);
  const Points line{Eigen::Vector2d(3, 4), Eigen::Vector2d(5, 4), Eigen::Vector2d(4, 4)};
  EXPECT_EQ(convexHull(line).size(), 2u);
}
