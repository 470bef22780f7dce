#include "quadmap/estimation/AxisRenaming.h"

#include <gtest/gtest.h>

#include <cmath>

#include "quadmap/geometry/Overlap.h"

using namespace quadmap;

TEST(AxisRenaming, LeavesTheObjectWhatItIs)
{
  UprightState x;
  x << 1, 2, 3, 0.4, std::log(0.5), std::log(0.2), std::log(0.8);
  for (int turns = -5; turns <= 5; ++turns)
  {
    const UprightState renamed = axisRenaming(turns).state(x);
    EXPECT_NEAR(renamed[3], 0.4 + turns * M_PI / 2, 1e-12);
    EXPECT_NEAR(cuboidIoU(ellipsoidOf(renamed), ellipsoidOf(x)), 1, 1e-9) << turns;
  }
}

TEST(AxisRenaming, BringsTheHeadingNearest)
{
  UprightState from = UprightState::Zero(), to = UprightState::Zero();
  for (double yaw = -7; yaw < 7; yaw += 0.3)
  {
    from[3] = yaw;
    to[3] = 1.1;
    EXPECT_LE(std::abs(axisRenaming(from, to).state(from)[3] - to[3]), M_PI / 4 + 1e-12) << yaw;
  }
}

TEST(AxisRenaming, RenamesACovarianceAlike)
{
  UprightCovariance S = UprightCovariance::Identity();
  S(4, 4) = 3;
  S(4, 0) = S(0, 4) = 0.5;
  const UprightCovariance renamed = axisRenaming(1).matrix(S);
  EXPECT_EQ(renamed(5, 5), 3);
  EXPECT_EQ(renamed(4, 4), 1);
  EXPECT_EQ(renamed(5, 0), 0.5);
}
