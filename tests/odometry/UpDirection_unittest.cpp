#include "quadmap/odometry/UpDirection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../surfaces/SyntheticFrame.h"

using namespace quadmap;
using Eigen::Vector3d;

namespace
{
/** Two walls; the robot's frame is that of the camera. */
SyntheticFrame corner(double pitchDown)
{
  SyntheticFrame frame(1.3, pitchDown);
  frame.noise = 0.0015;
  frame.hasFloor = false;
  frame.add(3.4, 0.0, 0.0, 0.1, {0.1, 8.0, 3.0});
  frame.add(1.5, 1.4, 0.0, 0.1, {6.0, 0.1, 3.0});
  return frame;
}

double errorOf(const SeenUp& seen, const SyntheticFrame& frame)
{
  const Vector3d up = frame.up_sensor();
  return std::atan2(seen.up_robot.cross(up).norm(), seen.up_robot.dot(up));
}

constexpr double kAccurate = 0.01;  // [rad]
}  // namespace

TEST(UpDirection, IsToldByTheFloor)
{
  SyntheticFrame frame = corner(0.5);
  frame.hasFloor = true;
  const auto seen = UpFinder({}).find(frame.scan(), Vector3d::UnitZ());
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->origin, UpOrigin::Floor);
  EXPECT_LT(errorOf(*seen, frame), kAccurate);
}

TEST(UpDirection, IsToldByWallsWithoutAFloor)
{
  const SyntheticFrame frame = corner(0.3);
  const auto seen = UpFinder({}).find(frame.scan(), Vector3d::UnitZ());
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->origin, UpOrigin::Surfaces);
  EXPECT_LT(errorOf(*seen, frame), kAccurate);
}

// A ceiling looks like the floor of an image that is upside down, which these are not.
TEST(UpDirection, IsToldByACeilingAndWalls)
{
  SyntheticFrame frame = corner(-0.5);
  frame.add(2.0, 0.0, 2.5, 0.1, {8.0, 8.0, 0.1});
  const auto seen = UpFinder({}).find(frame.scan(), Vector3d::UnitZ());
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->origin, UpOrigin::Surfaces);
  EXPECT_LT(errorOf(*seen, frame), kAccurate);
}

TEST(UpDirection, IsNotToldByASingleWall)
{
  SyntheticFrame frame(1.3, 0.1);
  frame.hasFloor = false;
  frame.add(2.4, 0.0, 0.0, 0.0, {0.1, 8.0, 3.0});
  EXPECT_FALSE(UpFinder({}).find(frame.scan(), Vector3d::UnitZ()));
}

TEST(UpDirection, IsAgreedOnByAMajorityOfAtLeastThree)
{
  const Vector3d up = Vector3d::UnitZ(), other = Vector3d(1, 0, 3).normalized();
  const auto agreed = agreedDirection({up, other, up, up, other});
  ASSERT_TRUE(agreed);
  EXPECT_EQ(agreed->direction, up);
  EXPECT_EQ(agreed->votes, 3u);
  EXPECT_TRUE(agreed->isMajorityOf(6));
  EXPECT_FALSE(agreed->isMajorityOf(7));
  EXPECT_FALSE(agreedDirection({up, up})->isMajorityOf(2));
}
