#include "quadmap/odometry/UpDirection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "../surfaces/SyntheticFrame.h"
#include "quadmap/geometry/PinholeCamera.h"

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

// Depth of the floor alone is wrong: it seems to rise by two degrees, and the wall in front says
// that it does not. Each counts by the share of the image that it covers.
TEST(UpDirection, WallsCorrectTheFloor)
{
  constexpr double kRise = 0.035;  // [rad]
  SyntheticFrame frame = corner(0.4);
  frame.hasFloor = true;
  auto scan = frame.scan();
  const Vector3d camera(0, 0, 1.3), foot(1.5, 0, 0), n(-std::sin(kRise), 0, std::cos(kRise));
  const Eigen::Matrix3d R =
      (frame.T_world_sensor + T_sensor_optical()).getRotationMatrix().asEigen();
  double floor = 0, wall = 0;  // pixels
  for (unsigned v = 0; v < frame.camera.nrows; ++v)
    for (unsigned u = 0; u < frame.camera.ncols; ++u)
    {
      const int shown = frame.look(u, v).first;
      wall += shown == 0 ? 1 : 0;
      if (shown != -1) continue;
      floor += 1;
      const Vector3d ray = R * Vector3d((u - 319.5) / 525, (v - 239.5) / 525, 1);
      const double depth = n.dot(foot - camera) / n.dot(ray);
      scan.rangeImage(static_cast<int>(v), static_cast<int>(u)) =
          static_cast<std::uint16_t>(depth / scan.rangeUnits);
    }
  const auto seen = UpFinder({}).find(scan, Vector3d::UnitZ());
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->origin, UpOrigin::Floor);
  EXPECT_NEAR(errorOf(*seen, frame), kRise * floor / (floor + wall), 0.1 * kRise);
  EXPECT_GT(wall, 0.4 * floor) << "or it would not matter";
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
