#include <gtest/gtest.h>

#include <cmath>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/perception/FramePerception.h"

// Sides that lean: screens, the backs of chairs (doc/mathematics.md, 8, "Heading" and "Faces").

namespace quadmap
{
namespace
{
constexpr double kTurned = 0.45;  // [rad]
constexpr double kLeans_deg[] = {0, 10, 19};

/** A panel of 0.5 by 0.36 m above a desk, whose top leans away from the camera. */
SyntheticFrame leaningPanel(double lean_deg)
{
  constexpr double kDeskTop = 0.72, kAbove = 0.02;  // [m]
  const Eigen::Vector3d half(0.015, 0.25, 0.18);
  const double lean = lean_deg * M_PI / 180;
  SyntheticFrame frame(1.35, 0.3);
  frame.noise = 0.0012;
  frame.add(1.6, 0.2, kDeskTop - 0.04, 0.0, {1.0, 2.0, 0.04});
  const double middle = kDeskTop + kAbove + half.z() * std::cos(lean);
  frame.boxes.push_back({Ellipsoid({1.5, 0.3, middle, kTurned, lean, 0}, half), true});
  return frame;
}

/** How far its complete measurement ends before the nearest corner of the panel and behind the
 * farthest one, along the true heading [m], and what the heading errs by [rad]. */
struct Errors
{
  double front = 1, back = 1, heading = 1;
};

Errors errorsOf(const SyntheticFrame& frame)
{
  CObservationObjects boxes = frame.observation({frame.detect(1, "tv")});
  FramePerception(PerceptionOptions(), LabelTable::installed())
      .measure(frame.scan(), boxes, frame.up_sensor());
  const ObjectMeasurement& m = boxes.objects.front().measurement;
  EXPECT_TRUE(m.complete) << m.reason;
  if (!m.complete) return {};
  const Ellipsoid world = m.complete->object_sensor.transformed(frame.T_world_sensor);
  const Eigen::Matrix3d R = world.rotation();
  const Eigen::Vector3d toCamera(-std::cos(kTurned), -std::sin(kTurned), 0);
  const Eigen::Index deep = std::abs(R.col(0).dot(toCamera)) > 0.7 ? 0 : 1;
  const double middle = world.center().dot(toCamera), half = world.semiAxes()[deep];
  const Ellipsoid& panel = frame.boxes[1].cuboid;
  const Eigen::Vector3d outwards = panel.rotation().transpose() * toCamera;
  const double trueMiddle = panel.center().dot(toCamera);
  const double trueHalf = outwards.cwiseAbs().dot(panel.semiAxes());
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  return {
      middle + half - trueMiddle - trueHalf, trueMiddle - trueHalf - middle + half,
      nearestEquivalentYaw(yaw, kTurned) - kTurned};
}

}  // namespace

TEST(LeaningThings, HaveTheHeadingOfTheirFaceWhenABoardHidesACorner)
{
  for (const double lean : kLeans_deg)
  {
    SyntheticFrame frame = leaningPanel(lean);
    frame.boxes.push_back({Ellipsoid({1.1, 0.36, 0.95, 0, 0, 0.5}, {0.01, 0.08, 0.4}), true});
    EXPECT_NEAR(errorsOf(frame).heading, 0, M_PI / 180) << lean;
  }
}

// Nobody sees the back: it is as far behind the front as screens usually are deep, where they lean.
TEST(LeaningThings, AreAsThickAsTheirLabelSays)
{
  constexpr double kTypical = 0.06, kTrue = 0.03;  // [m]
  for (const double lean : {10, 19})
    EXPECT_NEAR(errorsOf(leaningPanel(lean)).back, kTypical - kTrue, 0.012) << lean;
}

TEST(LeaningThings, EndWhereTheirFrontDoes)
{
  for (const double lean : kLeans_deg)
    EXPECT_NEAR(errorsOf(leaningPanel(lean)).front, 0, 0.007) << lean;
}

}  // namespace quadmap
