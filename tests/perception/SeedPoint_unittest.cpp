#include <gtest/gtest.h>

#include "SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

// Where an object without depth is taken to be.

namespace quadmap
{
namespace
{
/** The seed of a frame's last box, in the world. */
Eigen::Vector3d seedOfLast(const SyntheticFrame& frame, const std::string& label)
{
  CObservationObjects boxes = frame.observation({frame.detect(frame.boxes.size() - 1, label)});
  FramePerception(PerceptionOptions(), LabelTable::installed())
      .measure(frame.scan(), boxes, frame.up_sensor());
  const auto& seed = boxes.objects[0].measurement.seed_sensor;
  if (!seed)
  {
    ADD_FAILURE() << "no seed";
    return Eigen::Vector3d::Zero();
  }
  Eigen::Vector3d out;
  frame.T_world_sensor.composePoint(seed->x(), seed->y(), seed->z(), out.x(), out.y(), out.z());
  return out;
}

SyntheticFrame deskWithPhone()
{
  SyntheticFrame frame;
  frame.add(2.0, 0, 0, 0, {0.8, 1.6, 0.74});
  frame.add(2.0, 0.1, 0.74, 0.4, {0.16, 0.08, 0.01});
  frame.boxes.back().hasDepth = false;
  frame.noise = 0.0015;
  return frame;
}

TEST(SeedPoint, BlackPhoneLiesOnTheDeskAroundIt)
{
  const Eigen::Vector3d seed = seedOfLast(deskWithPhone(), "cell phone");
  EXPECT_NEAR((seed - Eigen::Vector3d(2.0, 0.1, 0.745)).norm(), 0, 0.015);
}

TEST(SeedPoint, DeskIsFoundBesideThingsOnIt)
{
  SyntheticFrame frame = deskWithPhone();
  frame.boxes.insert(
      frame.boxes.begin(), {Ellipsoid({2.16, 0.2, 0.79, 0, 0, 0}, {0.04, 0.04, 0.05}), true});
  const Eigen::Vector3d seed = seedOfLast(frame, "cell phone");
  EXPECT_NEAR((seed - Eigen::Vector3d(2.0, 0.1, 0.745)).norm(), 0, 0.03);
}

// Most of what surrounds a screen is the wall far behind it.
TEST(SeedPoint, ScreenIsAtItsStandNotAtTheWall)
{
  SyntheticFrame frame(1.2, 0.15);
  frame.add(4.5, 0, 0, 0, {0.1, 8, 3});
  frame.add(2.5, 0, 0, 0, {0.5, 1.2, 0.6});
  frame.add(2.5, 0, 0.6, 0, {0.05, 0.8, 0.5});
  frame.boxes.back().hasDepth = false;
  EXPECT_NEAR(seedOfLast(frame, "tv").x(), 2.45, 0.25);
}

}  // namespace
}  // namespace quadmap
