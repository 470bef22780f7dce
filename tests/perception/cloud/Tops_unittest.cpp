#include <gtest/gtest.h>

#include <cmath>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

namespace quadmap
{
namespace
{
/** Height of the measured top above the floor, and what it is worth. */
struct MeasuredTop
{
  bool isComplete = false;
  double height = 0;  // [m]
  FaceMeasurement worth;
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
  return {true, object.center().z() + object.semiAxes().z(), complete->faces[4]};
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
