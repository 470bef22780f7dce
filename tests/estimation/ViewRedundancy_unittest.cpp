#include "quadmap/estimation/ViewRedundancy.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace quadmap;

namespace
{
const Eigen::Vector3d kSeenPoint(0, 0, 1);
}

TEST(ViewRedundancy, ManyViewsFromOnePlaceAreWorthFourThirds)
{
  const ExistenceOptions options;
  const std::vector<Eigen::Vector3d> cameras(1000, Eigen::Vector3d(2, 0, 1));
  const auto shares = independentShares(cameras, kSeenPoint, options);
  EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 4.0 / 3, 1e-3);
}

TEST(ViewRedundancy, ViewsFartherApartThanTheReachAreIndependent)
{
  const ExistenceOptions options;
  const Eigen::Vector3d camera(2, 0, 1);
  const double reach = independentReach(camera, kSeenPoint, options);
  EXPECT_NEAR(reach, 2 * options.independentViewAngle, 1e-12);
  const Eigen::Vector3d away(0, reach, 0);
  EXPECT_EQ(sharedMistakes(camera, camera + away, reach), 0);
  EXPECT_NEAR(sharedMistakes(camera, camera + 0.5 * away, reach), 0.5, 1e-12);
  EXPECT_EQ(independentShare(camera, kSeenPoint, {camera + away}, options), 1);
  EXPECT_NEAR(independentShare(camera, kSeenPoint, {camera}, options), 1 / 1.75, 1e-12);
}
