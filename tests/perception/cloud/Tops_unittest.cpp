#include <gtest/gtest.h>

#include <cmath>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

namespace quadmap
{
namespace
{
/** Height of the measured top above the floor, what it is worth, and how the thing is turned. */
struct MeasuredTop
{
  bool isComplete = false;
  double height = 0;  // [m]
  FaceMeasurement worth;
  double yaw = 0;  // [rad], in [-pi/4, pi/4]
};

/** Of the one box of a frame. */
MeasuredTop topOf(const SyntheticFrame& frame, const DetectedObject& detection)
{
  static const LabelTable labels = LabelTable::installed();
  CObservationObjects boxes = frame.observation({detection});
  FramePerception(PerceptionOptions(), labels).measure(frame.scan(), boxes, frame.up_sensor());
  const auto& complete = boxes.objects.front().measurement.complete;
  if (!complete) return {};
  const Ellipsoid object = complete->object_sensor.transformed(frame.T_world_sensor);
  const Eigen::Matrix3d R = object.rotation();
  const double yaw = std::remainder(std::atan2(R(1, 0), R(0, 0)), M_PI / 2);
  return {true, object.center().z() + object.semiAxes().z(), complete->faces[4], yaw};
}

constexpr double kDeskHeight = 0.74;

/** A closed desk with a screen and a pile of paper on it that nobody detects; the desk's own pixels
 * make its box, and much of the screen is within. */
SyntheticFrame loadedDesk(double cameraHeight, double pitchDown)
{
  SyntheticFrame frame(cameraHeight, pitchDown);
  frame.noise = 0.0015;
  frame.add(2.4, 0.0, 0.0, 0.15, {0.8, 1.4, kDeskHeight});
  frame.add(2.5, 0.2, kDeskHeight, 0.15, {0.08, 0.6, 0.4});
  frame.add(2.3, -0.35, kDeskHeight, 0.4, {0.3, 0.22, 0.05});
  return frame;
}
}  // namespace

TEST(Tops, WhatStandsOnADeskIsNoPartOfIt)
{
  for (const double height : {1.2, 1.4, 1.7})
  {
    const SyntheticFrame frame = loadedDesk(height, 0.4);
    const MeasuredTop top = topOf(frame, frame.detect(0, "desk"));
    ASSERT_TRUE(top.isComplete) << height;
    EXPECT_NEAR(top.height, kDeskHeight, 0.006) << height;
    EXPECT_EQ(top.worth.kind, FaceKind::Measured);
  }
}

// Seen from near, a table fills the image, and nobody knows where the floor is. Its heading is not
// that of what stands on it.
TEST(Tops, ATableIsMeasuredWhereNoFloorIsSeen)
{
  constexpr double kYaw = 0.1;
  SyntheticFrame frame(1.3, 0.4);
  frame.hasFloor = false;
  frame.noise = 0.0015;
  frame.add(1.9, 0.0, kDeskHeight - 0.04, kYaw, {0.9, 1.3, 0.04});
  frame.add(1.9, 0.2, kDeskHeight, 0.6, {0.3, 0.2, 0.15});
  frame.add(1.8, -0.3, kDeskHeight, 0.6, {0.2, 0.25, 0.12});
  frame.add(3.4, 0.0, 0.0, 0.0, {0.1, 6.0, 2.5});  // a wall: its foot is out of sight
  const DetectedObject table = frame.detect(0, "dining table");
  const MeasuredTop top = topOf(frame, table);
  ASSERT_TRUE(top.isComplete);
  EXPECT_NEAR(top.height, kDeskHeight, 0.006);
  EXPECT_EQ(top.worth.kind, FaceKind::Measured);
  EXPECT_NEAR(top.yaw, kYaw, 0.02);
}

// Of a high cabinet no top is seen; what little is seen of a level surface is the plinth before it.
TEST(Tops, WhatLiesBelowACabinetIsNotItsTop)
{
  SyntheticFrame frame(1.3, 0.25);
  frame.hasFloor = false;
  frame.noise = 0.0015;
  frame.add(2.4, 0.0, 0.0, 0.1, {0.5, 0.9, 1.6});
  frame.add(1.9, 0.0, 0.0, 0.1, {0.4, 1.1, 0.06});
  DetectedObject cabinet = frame.detect(0, "cabinet");
  cabinet.box.y2 += 25;
  const MeasuredTop top = topOf(frame, cabinet);
  ASSERT_TRUE(top.isComplete);
  EXPECT_GT(top.height, 1.2);
}

TEST(Tops, OfAnotherKindOfThingTheUpperPartIsAPart)
{
  // The same shape by the name of something with a back.
  const SyntheticFrame frame = loadedDesk(1.4, 0.4);
  DetectedObject couch = frame.detect(0, "couch");
  const DetectedObject back = frame.detect(1, "couch");
  couch.box.y1 = std::min(couch.box.y1, back.box.y1);
  const MeasuredTop top = topOf(frame, couch);
  ASSERT_TRUE(top.isComplete);
  EXPECT_NEAR(top.height, kDeskHeight + 0.4, 0.02);
}

TEST(Tops, ARimCountsAsFarAsItIsAboveTheNoise)
{
  // A tray: its bottom is most of what is seen from above.
  constexpr double kBottom = 0.05, kRim = 0.058;
  SyntheticFrame frame(1.1, 0.75);
  frame.noise = 0.0008;
  frame.add(1.1, 0, 0, 0, {0.4, 0.5, kBottom});
  for (const double side : {-1.0, 1.0})
  {
    frame.add(1.1 + side * 0.2, 0, 0, 0, {0.03, 0.53, kRim});
    frame.add(1.1, side * 0.25, 0, 0, {0.4, 0.03, kRim});
  }
  DetectedObject tray = frame.detect(0, "suitcase");
  for (std::size_t i = 1; i < frame.boxes.size(); ++i)
  {
    const ImageBox rim = frame.detect(i, "suitcase").box;
    tray.box = {
        std::min(tray.box.x1, rim.x1), std::min(tray.box.y1, rim.y1), std::max(tray.box.x2, rim.x2),
        std::max(tray.box.y2, rim.y2)};
  }
  const MeasuredTop top = topOf(frame, tray);
  ASSERT_TRUE(top.isComplete);
  EXPECT_GT(top.height, kBottom + 0.002);
  EXPECT_LT(std::abs(top.height - kRim), 3 * top.worth.sigma);
}

}  // namespace quadmap
