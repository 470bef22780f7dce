#include "quadmap/surfaces/PlaneExtent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace quadmap;

namespace
{
std::vector<Eigen::Vector3d> randomPoints(int count, std::mt19937& random)
{
  std::uniform_real_distribution<double> anywhere(-0.5, 0.5);
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < count; ++i)
    out.emplace_back(2 * anywhere(random), anywhere(random), 0.01 * anywhere(random));
  return out;
}

/** A point is outside of a convex hull by its largest distance, over all directions, beyond the
 * farthest of the hull's points; inside by the smallest distance to a tangent. */
double outsideBySweeping(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& p)
{
  constexpr int kDirections = 3600;
  double farthest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kDirections; ++i)
  {
    const double angle = 2 * M_PI * i / kDirections;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    double reach = -std::numeric_limits<double>::infinity();
    for (const auto& q : points) reach = std::max(reach, direction.dot(q.head<2>()));
    farthest = std::max(farthest, direction.dot(p.head<2>()) - reach);
  }
  return farthest;
}

}  // namespace

TEST(PlaneExtent, KnowsHowFarOutsideAPointIs)
{
  std::mt19937 random(3);
  for (const int count : {1, 2, 3, 12})
  {
    const auto points = randomPoints(count, random);
    const PlaneExtent extent(Eigen::Vector3d::UnitZ(), points);
    for (const auto& p : randomPoints(50, random))
    {
      const double oracle = outsideBySweeping(points, 1.5 * p);
      EXPECT_NEAR(extent.outside(1.5 * p), oracle, 1e-3) << count << " points";
      const Eigen::Vector3d way = extent.toExtent(1.5 * p);
      EXPECT_NEAR(way.norm(), std::max(0.0, oracle), 1e-3) << count << " points";
      EXPECT_LT(extent.outside(1.5 * p + way), 1e-9) << count << " points";
      for (const double margin : {0.0, 0.02, 0.1, 0.5})
      {
        if (std::abs(oracle - margin) < 1e-3) continue;  // the sweep's step
        EXPECT_EQ(extent.isWithin(1.5 * p, margin), oracle < margin)
            << count << " points, margin " << margin << ", outside by " << oracle;
      }
    }
  }
}

TEST(PlaneExtent, ReachesEverywhereWhenNothingIsSaid)
{
  const PlaneExtent floor;
  EXPECT_TRUE(floor.isEverywhere());
  EXPECT_TRUE(floor.isWithin({1e6, 0, 0}, 0.0));
  EXPECT_EQ(floor.toExtent({1e6, 0, 0}).norm(), 0);
}
