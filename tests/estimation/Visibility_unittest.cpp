#include "quadmap/estimation/Visibility.h"

#include <gtest/gtest.h>

namespace quadmap
{
namespace
{
const Eigen::Vector3d kObject(0, 0, 0);

ObjectView seenFrom(double x, double y)
{
  ObjectView view;
  view.camera = {x, y, 0};
  return view;
}

double novelty(double x, double y, const std::deque<ObjectView>& earlier)
{
  return viewNovelty({x, y, 0}, kObject, earlier, ExistenceOptions());
}

TEST(ViewNovelty, CountsTheFirstViewInFull) { EXPECT_EQ(novelty(3, 0, {}), 1.0); }

TEST(ViewNovelty, CountsOneMoreViewFromTheSamePlaceLittle)
{
  EXPECT_EQ(novelty(3, 0, {seenFrom(3, 0)}), ExistenceOptions().repeatedViewWeight);
}

TEST(ViewNovelty, GrowsWithTheAngleTheCameraMovedAroundTheObject)
{
  // 0.1 rad at 3 m is 0.3 m: half of that counts half (the range grows by a thousandth, too).
  EXPECT_NEAR(novelty(3, 0.15, {seenFrom(3, 0)}), 0.5, 2e-3);
  EXPECT_EQ(novelty(3, 0.9, {seenFrom(3, 0)}), 1.0);
  EXPECT_NEAR(novelty(6, 0.15, {seenFrom(6, 0)}), 0.25, 1e-9)
      << "farther off, the same step is less";
}

TEST(ViewNovelty, ComparesWithTheNearestEarlierView)
{
  EXPECT_NEAR(novelty(3, 0.15, {seenFrom(3, 2), seenFrom(3, 0), seenFrom(-3, 0)}), 0.5, 2e-3);
}

}  // namespace
}  // namespace quadmap
