#include <gtest/gtest.h>

#include <cmath>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

namespace quadmap
{
namespace
{
/** What the sides of an object that stand across the line of sight are worth. */
struct AcrossSides
{
  FaceKind near = FaceKind::Unknown, far = FaceKind::Unknown;
  double farX = 0;  // where the far one is [m]
};

AcrossSides acrossSides(const SyntheticFrame& frame, const DetectedObject& detection)
{
  static const LabelTable labels = LabelTable::installed();
  CObservationObjects boxes = frame.observation({detection});
  FramePerception(PerceptionOptions(), labels).measure(frame.scan(), boxes, frame.up_sensor());
  const auto& m = boxes.objects.front().measurement;
  EXPECT_TRUE(m.complete) << m.reason;
  AcrossSides out;
  if (!m.complete) return out;
  const Ellipsoid world = m.complete->object_sensor.transformed(frame.T_world_sensor);
  for (std::size_t f = 0; f < 4; ++f)
  {
    const auto axis = static_cast<Eigen::Index>(f / 2);
    const Eigen::Vector3d n = (f % 2 == 0 ? 1.0 : -1.0) * world.rotation().col(axis);
    if (n.x() < -0.9) out.near = m.complete->faces[f].kind;
    if (n.x() < 0.9) continue;
    out.far = m.complete->faces[f].kind;
    out.farX = n.dot(world.center()) + world.semiAxes()[axis];
  }
  return out;
}

constexpr double kBackX = 2.35, kBackThick = 0.05;

/** A chair's back, box 0. Of the rest nothing is seen. */
SyntheticFrame chairBack()
{
  SyntheticFrame frame(1.5, 0.45);
  frame.noise = 0.001;
  frame.add(kBackX, 0.0, 0.0, 0.0, {kBackThick, 0.45, 0.9});
  return frame;
}
}  // namespace

TEST(HiddenSides, AChairPushedUnderATableReachesUnderIt)
{
  for (const bool floorIsSeen : {true, false})
  {
    SyntheticFrame frame = chairBack();
    frame.hasFloor = floorIsSeen;
    frame.add(1.85, 0.0, 0.0, 0.0, {0.8, 1.6, 0.72});  // 8 cm before the back
    const AcrossSides sides = acrossSides(frame, frame.detect(0, "chair"));
    EXPECT_EQ(sides.near, FaceKind::AtLeast) << "the seat may be under the table";
    EXPECT_EQ(sides.far, FaceKind::Measured) << "and is then not behind the back";
    EXPECT_NEAR(sides.farX, kBackX + 0.5 * kBackThick, 0.03);
  }
}

TEST(HiddenSides, WhatStandsFarBeforeAChairTellsNothingOfItsSeat)
{
  SyntheticFrame frame = chairBack();
  frame.add(1.3, 0.0, 0.0, 0.0, {0.1, 1.6, 0.95});
  const AcrossSides sides = acrossSides(frame, frame.detect(0, "chair"));
  EXPECT_EQ(sides.far, FaceKind::AtLeast);
}

TEST(HiddenSides, MissingDepthAlongTheBorderIsNoEnd)
{
  SyntheticFrame frame;
  frame.add(2.0, 1.1, 0.0, 0.0, {0.6, 0.8, 0.7});  // reaches beyond the left image border
  auto scan = frame.scan();
  constexpr int kBlind = 40;  // columns, as registered depth has them [px]
  for (int v = 0; v < static_cast<int>(frame.camera.nrows); ++v)
    for (int u = 0; u < kBlind; ++u) scan.rangeImage(v, u) = 0;
  CObservationObjects boxes = frame.observation({frame.detect(0, "microwave")});
  FramePerception(PerceptionOptions(), LabelTable::installed())
      .measure(scan, boxes, frame.up_sensor());
  const auto& m = boxes.objects.front().measurement;
  ASSERT_TRUE(m.complete) << m.reason;
  const Ellipsoid world = m.complete->object_sensor.transformed(frame.T_world_sensor);
  for (std::size_t f = 0; f < 4; ++f)
  {
    const auto axis = static_cast<Eigen::Index>(f / 2);
    if ((f % 2 == 0 ? 1.0 : -1.0) * world.rotation().col(axis).y() > 0.9)
    {
      EXPECT_EQ(m.complete->faces[f].kind, FaceKind::AtLeast);
    }
  }
}

}  // namespace quadmap
