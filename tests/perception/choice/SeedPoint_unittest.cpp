#include <gtest/gtest.h>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

// Where an object without depth is taken to be.

namespace quadmap
{
namespace
{
/** The seed of a detected thing, in the world. */
Eigen::Vector3d seedIn(const SyntheticFrame& frame, const DetectedObject& detected)
{
  CObservationObjects boxes = frame.observation({detected});
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

Eigen::Vector3d seedOfLast(const SyntheticFrame& frame, const std::string& label)
{
  return seedIn(frame, frame.detect(frame.boxes.size() - 1, label));
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

// Depth is there of the pot only; the stems are thinner than a pixel.
TEST(SeedPoint, IsInTheMiddleOfTheBoxWhateverPartHasDepth)
{
  SyntheticFrame frame(1.2, 0.3);
  frame.noise = 0.0015;
  frame.add(2.5, 0.2, 0, 0, {0.28, 0.28, 0.28});
  frame.add(2.5, 0.2, 0, 0, {0.6, 0.6, 1.0});
  const ImageBox whole = frame.detect(1, "potted plant").box;
  frame.boxes.pop_back();
  DetectedObject plant;
  plant.label = "potted plant";
  plant.box = whole;
  const Eigen::Vector3d seed = seedIn(frame, plant);
  EXPECT_NEAR(seed.y(), 0.2, 0.05);
  EXPECT_NEAR(seed.z(), 0.5, 0.1);
}

/** A plant of a few thin stems in the corner of two walls, left and behind. */
SyntheticFrame plantInCorner()
{
  SyntheticFrame frame(1.0, 0.1);
  frame.noise = 0.0019;  // of a Kinect
  frame.add(4.1, 0, 0, 0, {0.2, 9, 2.6});
  frame.add(2.0, 1.3, 0, 0, {5, 0.2, 2.6});
  for (int i = -3; i <= 3; ++i)
    frame.add(3.5 + 0.04 * i, 0.75 + 0.1 * i, 0.25, 0, {0.02, 0.02, 0.85});
  frame.add(3.5, 0.75, 0, 0, {0.28, 0.28, 0.25});
  return frame;
}

TEST(SeedPoint, WallsOfACornerAreSeenThroughAPlant)
{
  const SyntheticFrame frame = plantInCorner();
  DetectedObject plant = frame.detect(2, "potted plant");
  for (std::size_t i = 3; i < frame.boxes.size(); ++i)
  {
    const ImageBox part = frame.detect(i, "").box;
    plant.box = {
        std::min(plant.box.x1, part.x1), std::min(plant.box.y1, part.y1),
        std::max(plant.box.x2, part.x2), std::max(plant.box.y2, part.y2)};
  }
  EXPECT_NEAR(seedIn(frame, plant).x(), 3.5, 0.15);
}

}  // namespace
}  // namespace quadmap
