#include "quadmap/perception/FloorTracker.h"

#include <gtest/gtest.h>

namespace quadmap
{
namespace
{
const mrpt::poses::CPose3D kSensor(1.0, -2.0, 1.4, 0.3, 0.4, 0.05);

Plane horizontalAt(double z) { return Plane{Eigen::Vector3d::UnitZ(), -z}.transformed(-kSensor); }

TEST(FloorTracker, KnowsNothingBeforeSeveralFramesAgree)
{
  FloorTracker tracker;
  EXPECT_FALSE(tracker.height());
  tracker.add(horizontalAt(0.0), kSensor);
  tracker.add(horizontalAt(0.01), kSensor);
  EXPECT_FALSE(tracker.height());
  tracker.add(horizontalAt(0.02), kSensor);
  ASSERT_TRUE(tracker.height());
  EXPECT_NEAR(*tracker.height(), 0.01, 1e-9);
}

TEST(FloorTracker, PrefersTheLowestSurfaceSeveralFramesAgreeOn)
{
  FloorTracker tracker;
  for (int i = 0; i < 30; ++i) tracker.add(horizontalAt(0.75), kSensor);  // table tops
  for (int i = 0; i < 5; ++i) tracker.add(horizontalAt(0.0), kSensor);
  tracker.add(horizontalAt(-0.9), kSensor);  // one reflection below the floor
  EXPECT_NEAR(*tracker.height(), 0.0, 1e-9);
}

TEST(FloorTracker, ForgetsTheStoreyItLeft)
{
  FloorTracker tracker;
  for (int i = 0; i < 50; ++i) tracker.add(horizontalAt(0.0), kSensor);
  for (int i = 0; i < 200; ++i) tracker.add(horizontalAt(2.8), kSensor);
  EXPECT_NEAR(*tracker.height(), 2.8, 1e-9);
}

TEST(FloorTracker, IgnoresSurfacesThatAreNotLevel)
{
  FloorTracker tracker;
  const Plane wall = Plane{Eigen::Vector3d::UnitX(), 3.0}.transformed(-kSensor);
  for (int i = 0; i < 10; ++i) tracker.add(wall, kSensor);
  EXPECT_FALSE(tracker.height());
}

TEST(FloorTracker, GivesTheFloorInTheSensorFrame)
{
  FloorTracker tracker;
  for (int i = 0; i < 3; ++i) tracker.add(horizontalAt(0.2), kSensor);
  const auto floor = tracker.inSensor(kSensor);
  ASSERT_TRUE(floor);
  mrpt::math::TPoint3D p_sensor = (-kSensor).composePoint({5.0, 4.0, 0.2});
  EXPECT_NEAR(floor->signedDistance({p_sensor.x, p_sensor.y, p_sensor.z}), 0.0, 1e-9);
}

}  // namespace
}  // namespace quadmap
