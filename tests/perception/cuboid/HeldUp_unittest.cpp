#include <gtest/gtest.h>
#include <mrpt/core/format.h>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

// Where an object ends that something else holds up (doc/mathematics.md, 8, "Held up").

namespace quadmap
{
namespace
{
constexpr double kDesk = 0.72, kLift = 0.08, kPanelHeight = 0.34;  // [m]
constexpr std::size_t kPanel = 1, kFoot = 3;                       // boxes of the frame

/** A monitor on a table: a panel before the neck of its stand, and the foot. */
SyntheticFrame monitorOnTable()
{
  SyntheticFrame frame(1.25, 0.25);
  frame.noise = 0.0012;
  frame.add(1.8, 0.0, kDesk - 0.04, 0.0, {0.8, 1.6, 0.04});
  frame.add(1.7, 0.1, kDesk + kLift, 0.15, {0.05, 0.5, kPanelHeight});
  frame.add(1.76, 0.1, kDesk, 0.15, {0.03, 0.06, kLift + 0.1});
  frame.add(1.74, 0.1, kDesk, 0.15, {0.2, 0.24, 0.02});
  return frame;
}

/** Where an object ends by its complete measurement. */
struct Ends
{
  std::string reason;
  double height = 0;                  // of the bottom above the floor [m]
  double thickness = 0;               // the least horizontal size [m]
  double sigma = 0;                   // of the bottom [m]
  FaceKind kind = FaceKind::Unknown;  // of the bottom
};

Ends endsOf(const SyntheticFrame& frame, const std::vector<DetectedObject>& objects)
{
  CObservationObjects boxes = frame.observation(objects);
  FramePerception(PerceptionOptions(), LabelTable::installed())
      .measure(frame.scan(), boxes, frame.up_sensor());
  const ObjectMeasurement& m = boxes.objects.front().measurement;
  Ends out{m.reason};
  if (!m.complete) return out;
  const Ellipsoid world = m.complete->object_sensor.transformed(frame.T_world_sensor);
  out.height = world.center().z() - world.semiAxes().z();
  out.thickness = 2 * world.semiAxes().head<2>().minCoeff();
  out.sigma = m.complete->faces[kFaces - 1].sigma;
  out.kind = m.complete->faces[kFaces - 1].kind;
  return out;
}

/** The box of the panel, with its lower edge moved down. */
DetectedObject panel(const SyntheticFrame& frame, const std::string& label, double down_px = 0)
{
  DetectedObject out = frame.detect(kPanel, label);
  out.box.y2 += down_px;
  return out;
}

}  // namespace

TEST(HeldUp, AScreenEndsWhereItsPanelDoes)
{
  const SyntheticFrame frame = monitorOnTable();
  for (const double loose_px : {-3.0, 0.0, 4.0})
  {
    const Ends end = endsOf(frame, {panel(frame, "tv", loose_px)});
    EXPECT_EQ(end.kind, FaceKind::Measured) << end.reason;
    EXPECT_NEAR(end.height, kDesk + kLift, 0.02) << "the box is wrong by " << loose_px << " px";
  }
}

TEST(HeldUp, AnEndThatItsBoxContradictsIsKnownNoBetter)
{
  const SyntheticFrame frame = monitorOnTable();
  constexpr double kRange = 1.7;  // of the panel [m]
  for (const double loose_px : {0.0, 4.0, 8.0})
  {
    const Ends end = endsOf(frame, {panel(frame, "tv", loose_px)});
    EXPECT_EQ(end.kind, FaceKind::Measured) << end.reason;
    EXPECT_GT(end.sigma, 0.8 * loose_px * kRange / frame.camera.fy()) << loose_px;
  }
}

TEST(HeldUp, ABoxDownToTheSupportMeansWhatStandsOnIt)
{
  const SyntheticFrame frame = monitorOnTable();
  DetectedObject all = panel(frame, "tv");
  all.box.y2 = frame.detect(kFoot, "tv").box.y2;
  const Ends end = endsOf(frame, {all});
  EXPECT_EQ(end.kind, FaceKind::Support) << end.reason;
  EXPECT_NEAR(end.height, kDesk, 0.01);
}

TEST(HeldUp, TheLowFootOfAScreenIsNoPartOfItAlthoughItsBoxShowsIt)
{
  // Seen at an angle, the rectangle of the box has the foot in it, which meets the table.
  const double lift = 0.06, thick = 0.05, turn = 0.6;
  for (const double depth : {0.22, 0.4})
    for (const double loose_px : {-2.0, 0.0, 2.0})
    {
      SyntheticFrame frame(1.25, 0.2);
      frame.noise = 0.003;
      frame.add(1.9, 0.0, kDesk - 0.04, 0.0, {1.0, 2.0, 0.04});
      frame.add(1.8, 0.1, kDesk + lift, turn, {thick, 1.05, 0.62});
      frame.add(1.8, 0.1, kDesk, turn, {depth, 0.5, 0.02});
      frame.add(1.8, 0.1, kDesk, turn, {thick, 0.16, lift});
      const Ends ends = endsOf(frame, {panel(frame, "tv", loose_px)});
      const std::string which = mrpt::format("foot of %.2f m, box off by %g px", depth, loose_px);
      EXPECT_EQ(ends.kind, FaceKind::Measured) << ends.reason << ", " << which;
      EXPECT_NEAR(ends.height, kDesk + lift, std::min(0.04, 3 * ends.sigma)) << which;
      // Nobody sees its back, so that it says "at least".
      EXPECT_LT(ends.thickness, thick + 0.02) << which;
    }
}

TEST(HeldUp, AStandThatGivesNoDepthHoldsAScreenUpAsWell)
{
  // 120 rows of the cloud: no end of a line is the lowest by chance.
  SyntheticFrame frame(1.25, 0.2);
  frame.noise = 0.003;
  frame.add(1.9, 0.0, kDesk - 0.04, 0.0, {1.0, 2.0, 0.04});
  frame.add(1.5, 0.1, kDesk + 0.1, 0.2, {0.05, 1.0, 0.68});
  const Ends end = endsOf(frame, {panel(frame, "tv")});
  EXPECT_EQ(end.kind, FaceKind::Measured) << end.reason;
  EXPECT_NEAR(end.height, kDesk + 0.1, 0.02);
}

TEST(HeldUp, WhatGoesOnBelowItsBoxStands)
{
  for (const double short_px : {0.0, 6.0, 10.0, 12.0, 16.0})
  {
    SyntheticFrame frame(1.25, 0.25);
    frame.noise = 0.003;
    frame.add(1.8, 0.0, kDesk - 0.04, 0.0, {0.8, 1.6, 0.04});
    frame.add(1.7, 0.1, kDesk, 0.4, {0.2, 0.3, 0.3});
    const Ends ends = endsOf(frame, {panel(frame, "box", -short_px)});
    EXPECT_EQ(ends.kind, FaceKind::Support) << ends.reason << ", short by " << short_px << " px";
  }
}

TEST(HeldUp, ASideOfTheBoxTellsNothingOfTheBottom)
{
  // A rolled camera: the bottom looks out over the right edge of the box a little as well.
  SyntheticFrame frame;
  frame.T_world_sensor = mrpt::poses::CPose3D(0, 0, 1.25, 0, 0.25, 0.4);
  frame.noise = 0.003;
  frame.add(1.8, 0.0, kDesk - 0.04, 0.0, {0.8, 1.6, 0.04});
  frame.add(1.7, 0.1, kDesk, 0.4, {0.2, 0.3, 0.3});
  for (const double narrow_px : {0.0, 12.0})
  {
    DetectedObject box = frame.detect(1, "box");
    box.box.x2 -= narrow_px;
    const Ends ends = endsOf(frame, {box});
    EXPECT_EQ(ends.kind, FaceKind::Support) << ends.reason << ", narrow by " << narrow_px << " px";
    EXPECT_NEAR(ends.height, kDesk, 0.01);
  }
}

TEST(HeldUp, WhatStandsOnFloorsIsNotHeldUp)
{
  // The legs of a chair give no depth, and a weak detector's box ends at the seat.
  SyntheticFrame frame;
  frame.noise = 0.0012;
  frame.add(2.2, 0.0, 0.42, 0.2, {0.45, 0.45, 0.05});
  frame.add(2.4, 0.04, 0.47, 0.2, {0.04, 0.45, 0.4});
  for (const std::string label : {"chair", "box"})
  {
    DetectedObject seat = frame.detect(0, label);
    seat.box.y1 = frame.detect(1, label).box.y1;
    const Ends end = endsOf(frame, {seat});
    EXPECT_EQ(end.kind == FaceKind::Support, label == "chair") << end.reason;
    EXPECT_NEAR(end.height, label == "chair" ? 0 : 0.42, 0.02);
  }
}

TEST(HeldUp, WhatSomethingNearerHidesMayStandOnItsSupport)
{
  SyntheticFrame frame(1.25, 0.25);
  frame.noise = 0.0012;
  frame.add(1.8, 0.0, kDesk - 0.04, 0.0, {0.8, 1.6, 0.04});
  frame.add(1.9, 0.0, kDesk, 0.1, {0.2, 0.4, 0.4});   // a box
  frame.add(1.6, 0.0, kDesk, 0.0, {0.05, 0.9, 0.1});  // before its lower end
  const Ends end = endsOf(frame, {frame.detect(1, "box")});
  EXPECT_EQ(end.kind, FaceKind::Support) << end.reason;
  EXPECT_NEAR(end.height, kDesk, 0.01);
}

TEST(HeldUp, NothingIsSeenToBeFromStraightAbove)
{
  SyntheticFrame frame(2.3, M_PI_2 - 0.02);
  frame.noise = 0.0012;
  frame.add(0.0, 0.0, kDesk - 0.04, 0.0, {1.6, 1.6, 0.04});
  frame.add(0.05, 0.1, kDesk, 0.3, {0.3, 0.4, 0.3});
  const Ends end = endsOf(frame, {frame.detect(1, "box")});
  EXPECT_EQ(end.kind, FaceKind::Support) << end.reason;
  EXPECT_NEAR(end.height, kDesk, 0.01);
}

}  // namespace quadmap
