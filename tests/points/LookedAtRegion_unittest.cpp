#include "LookedAtRegion.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>

using namespace quadmap;

namespace
{
/** Random points in a sector of 2 rad, up to 4 m away and, in space, 1.5 m high. */
template <int D>
std::vector<PointVector<D>> sector(std::size_t n)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> bearing(-1, 1), range(0.5, 4), height(0, 1.5);
  std::vector<PointVector<D>> points;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double b = bearing(random), r = range(random);
    PointVector<D> p;
    p[0] = r * std::cos(b);
    p[1] = r * std::sin(b);
    if constexpr (D == 3) p[2] = height(random);
    points.push_back(p);
  }
  return points;
}

template <int D>
void expectCountsOfACircle()
{
  constexpr double kGrain = 0.1 * 1.74;  // largest error of a distance of two cells [m]
  const auto points = sector<D>(3000);
  const LookedAtRegion<D> view(points);
  for (std::size_t i = 0; i < points.size(); i += 30)
  {
    std::size_t surely = 0, perhaps = 0;
    for (const auto& p : points)
    {
      surely += (p - points[i]).norm() < 0.5 - kGrain;
      perhaps += (p - points[i]).norm() < 0.5 + kGrain;
    }
    EXPECT_GE(view.near(points[i]), surely);
    EXPECT_LE(view.near(points[i]), perhaps);
  }
}

}  // namespace

TEST(LookedAtRegion, CountsWhatIsNear)
{
  expectCountsOfACircle<2>();
  expectCountsOfACircle<3>();
}

TEST(LookedAtRegion, LooksWhereThingsWereMeasured)
{
  const LookedAtRegion<2> view(sector<2>(3000));
  EXPECT_TRUE(view.contains({2, 0}));
  EXPECT_FALSE(view.contains({-2, 0})) << "behind";
  EXPECT_FALSE(view.contains({6, 0})) << "too far";
  EXPECT_FALSE(LookedAtRegion<2>().contains({2, 0}));
  EXPECT_FALSE(LookedAtRegion<2>(sector<2>(5)).contains({2, 0})) << "too few to tell";
}

TEST(LookedAtRegion, IsQuickForLongRecordings)
{
  constexpr std::size_t kKeyframes = 2000, kPerKeyframe = 10, kObjects = 50;
  const auto points = sector<3>(kKeyframes * kPerKeyframe);
  const auto start = std::chrono::steady_clock::now();
  const LookedAtRegion<3> view(points);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < kKeyframes * kObjects; ++i)
    seen += view.contains(points[i % points.size()]);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  EXPECT_GT(seen, kKeyframes * kObjects / 2);
  EXPECT_LT(time.count(), 5.0) << "[s], about 0.5 s on one core; each with each takes far longer";
}
