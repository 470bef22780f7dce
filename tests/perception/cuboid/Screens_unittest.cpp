#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

// Flat things on walls, of which depth shows a part or none (doc/mathematics.md, 7, 8 and 10).

namespace quadmap
{
namespace
{
constexpr double kWall = 2.60, kFront = 2.45, kThick = 0.04;  // [m]

/** A television of 0.8 by 0.48 m before a wall. The part of it on the right of the middle by `dark`
 * returns no depth. Box 0 is the wall, the others are its parts. */
SyntheticFrame television(double dark)
{
  SyntheticFrame frame(1.3, 0.0);
  frame.noise = 0.0012;
  frame.add(kWall + 0.05, 0.0, 0.0, 0.0, {0.1, 5.0, 2.6});
  frame.add(kFront + 0.5 * kThick, 0.2 + 0.5 * dark, 1.1, 0.0, {kThick, 0.4 - dark, 0.48});
  if (dark > -0.4)
  {
    frame.add(kFront + 0.5 * kThick, -0.2 + 0.5 * dark, 1.1, 0.0, {kThick, 0.4 + dark, 0.48});
    frame.boxes.back().hasDepth = false;
  }
  return frame;
}

/** Around both parts, larger than they are by `loose` pixels: there the box shows the wall. */
DetectedObject boxOf(const SyntheticFrame& frame, double loose)
{
  DetectedObject out = frame.detect(1, "tv");
  const DetectedObject other = frame.detect(frame.boxes.size() - 1, "tv");
  out.box = {
      std::min(out.box.x1, other.box.x1) - loose, std::min(out.box.y1, other.box.y1) - loose,
      std::max(out.box.x2, other.box.x2) + loose, std::max(out.box.y2, other.box.y2) + loose};
  return out;
}

struct Seen
{
  ObjectMeasurement measurement;
  double front = 0, back = 0, width = 0, height = 0;  // of the cuboid [m]
  double turned = 0;                                  // its front from the wall [rad]
  FaceKind backKind = FaceKind::Unknown;
};

Seen look(
    const SyntheticFrame& frame,
    const mrpt::obs::CObservation3DRangeScan& scan,
    const DetectedObject& box)
{
  CObservationObjects boxes = frame.observation({box});
  FramePerception(PerceptionOptions(), LabelTable::installed())
      .measure(scan, boxes, frame.up_sensor());
  Seen out{boxes.objects.front().measurement};
  if (!out.measurement.complete) return out;
  const Ellipsoid world = out.measurement.complete->object_sensor.transformed(frame.T_world_sensor);
  const Eigen::Matrix3d R = world.rotation();
  const Eigen::Index deep = std::abs(R(0, 0)) > 0.7 ? 0 : 1;
  out.front = world.center().x() - world.semiAxes()[deep];
  out.back = world.center().x() + world.semiAxes()[deep];
  out.width = 2 * world.semiAxes()[1 - deep];
  out.height = 2 * world.semiAxes().z();
  const bool isPlus = R(0, deep) > 0;
  out.turned = std::atan2(R(1, deep), R(0, deep)) - (isPlus ? 0 : std::copysign(M_PI, R(1, deep)));
  out.backKind =
      out.measurement.complete->faces[static_cast<std::size_t>(2 * deep) + (isPlus ? 0 : 1)].kind;
  return out;
}

/** A picture of 0.6 by 0.45 m on the wall. */
Seen lookAtPicture(double thick, double noise)
{
  SyntheticFrame frame(1.3, 0.0);
  frame.noise = noise;
  frame.add(kWall + 0.05, 0.0, 0.0, 0.0, {0.1, 5.0, 2.6});
  frame.add(kWall - 0.5 * thick, 0.2, 1.2, 0.0, {thick, 0.6, 0.45});
  return look(frame, frame.scan(), frame.detect(1, "picture"));
}

/** The rims of the wall's part of the image bleed towards the screen, as those of real cameras do.
 */
mrpt::obs::CObservation3DRangeScan bleeding(const SyntheticFrame& frame)
{
  auto scan = frame.scan();
  constexpr int kReach = 8;  // [px]
  const auto exact = scan;
  for (int v = 0; v < scan.rangeImage.rows(); ++v)
    for (int u = 0; u < scan.rangeImage.cols(); ++u)
    {
      if (frame.look(static_cast<unsigned>(u), static_cast<unsigned>(v)).first != 0) continue;
      for (int i = 1; i <= kReach; ++i)
      {
        const int c = std::min(u + i, static_cast<int>(scan.rangeImage.cols()) - 1);
        if (frame.look(static_cast<unsigned>(c), static_cast<unsigned>(v)).first != 1) continue;
        const double z = 1e-4 * exact.rangeImage(v, u), near = 1e-4 * exact.rangeImage(v, c);
        const double share = 0.45 * (1.0 - static_cast<double>(i) / kReach);
        scan.rangeImage(v, u) = static_cast<std::uint16_t>((z - share * (z - near)) / 1e-4);
        break;
      }
    }
  return scan;
}
}  // namespace

TEST(Screens, TheWallBehindIsNoPartOfWhatHangsOnIt)
{
  const SyntheticFrame frame = television(-0.4);
  const Seen seen = look(frame, bleeding(frame), boxOf(frame, 8));
  ASSERT_TRUE(seen.measurement.complete) << seen.measurement.reason;
  EXPECT_NEAR(seen.front, kFront, 0.01);
  EXPECT_LT(seen.back, kFront + 0.05) << "the wall is " << kWall - kFront << " m behind the front";
  EXPECT_NE(seen.backKind, FaceKind::Measured) << "nobody saw it";
  EXPECT_NEAR(seen.width, 0.8, 0.03);
}

TEST(Screens, TheRimTellsNothingOfABackThatNobodySaw)
{
  // The rim of a real screen bleeds to the wall half a metre behind it.
  SyntheticFrame frame = television(-0.4);
  frame.boxes.front().cuboid = Ellipsoid({kFront + 0.55, 0, 1.3, 0, 0, 0}, {0.05, 2.5, 1.3});
  auto scan = frame.scan();
  constexpr int kRim = 4;            // [px]
  constexpr double kPerPixel = 220;  // [0.1 mm]
  const auto isPanel = [&](int u, int v)
  { return frame.look(static_cast<unsigned>(u), static_cast<unsigned>(v)).first == 1; };
  for (int v = 0; v < scan.rangeImage.rows(); ++v)
    for (int u = kRim; u + kRim < scan.rangeImage.cols(); ++u)
      for (int i = 1; isPanel(u, v) && i <= kRim; ++i)
        if (!isPanel(u - i, v) || !isPanel(u + i, v))
        {
          const double bled = scan.rangeImage(v, u) + kPerPixel * (kRim + 1 - i);
          scan.rangeImage(v, u) = static_cast<std::uint16_t>(bled);
          break;
        }
  const Seen seen = look(frame, scan, boxOf(frame, 0));
  ASSERT_TRUE(seen.measurement.complete) << seen.measurement.reason;
  EXPECT_NE(seen.backKind, FaceKind::Measured);
  EXPECT_LT(seen.back, kFront + kThick) << "what is said at least must be so";
}

TEST(Screens, EndWhereTheBoxDoesWhenDepthShowsAPartOfTheFrontOnly)
{
  const SyntheticFrame frame = television(0.1);
  const Seen seen = look(frame, frame.scan(), boxOf(frame, 0));
  ASSERT_TRUE(seen.measurement.complete) << seen.measurement.reason;
  EXPECT_NEAR(seen.front, kFront, 0.01);
  EXPECT_NEAR(seen.width, 0.8, 0.02);
  EXPECT_NEAR(seen.height, 0.48, 0.02);
  const auto faces = seen.measurement.complete->faces;
  const auto measured = std::count_if(
      faces.begin(), faces.end(), [](const auto& f) { return f.kind != FaceKind::Unknown; });
  EXPECT_EQ(measured, 1) << "the front; its sides are told by the edges of the box";
}

TEST(Screens, AreBroadInFrontAlsoWhenTheirSideIsTurnedToTheCamera)
{
  constexpr double kTurn = 62 * M_PI / 180, kShown = 0.25, kDark = 0.55;  // [rad], widths [m]
  const Eigen::Vector2d out(std::cos(kTurn), std::sin(kTurn)), along(-out.y(), out.x());
  for (const double thick : {0.04, 0.08})
  {
    SyntheticFrame frame(1.3, 0.0);
    frame.noise = 0.0012;
    const auto add = [&](double middle, double width)
    {
      const Eigen::Vector2d at = Eigen::Vector2d(1.8, 0.0) + middle * along;
      frame.add(at.x(), at.y(), 1.1, kTurn, {thick, width, 0.48});
    };
    frame.add(5.0, 0.0, 0.0, 0.0, {0.1, 8.0, 2.6});
    add(-0.5 * kDark, kShown);
    add(0.5 * kShown, kDark);
    frame.boxes.back().hasDepth = false;
    const Seen seen = look(frame, frame.scan(), boxOf(frame, 0));
    EXPECT_EQ(seen.measurement.reason, "screen on its front");
    ASSERT_TRUE(seen.measurement.complete);
    const auto& cuboid = *seen.measurement.complete;
    const Eigen::Matrix3d R = cuboid.object_sensor.transformed(frame.T_world_sensor).rotation();
    for (std::size_t f = 0; f < 4; ++f)
    {
      if (cuboid.faces[f].kind != FaceKind::Measured) continue;
      EXPECT_GT(std::abs(R.col(static_cast<Eigen::Index>(f / 2)).head<2>().dot(out)), 0.97) << f;
    }
  }
}

TEST(Screens, WhatErrsMostIsNotWhereTheFrontIs)
{
  // A front is where most of its points are, also when they scatter twice as much as expected.
  SyntheticFrame frame = television(-0.4);
  frame.noise = 0.003;
  const Seen seen = look(frame, frame.scan(), boxOf(frame, 0));
  ASSERT_TRUE(seen.measurement.complete) << seen.measurement.reason;
  EXPECT_NEAR(seen.front, kFront, 0.008);
}

TEST(OnWall, ThingsEndAtTheWall)
{
  const Seen seen = lookAtPicture(0.12, 0.0012);
  ASSERT_TRUE(seen.measurement.complete) << seen.measurement.reason;
  EXPECT_EQ(seen.measurement.reason, "cuboid fits the box");
  EXPECT_NEAR(seen.back, kWall, 0.003);
  EXPECT_NEAR(seen.front, kWall - 0.12, 0.003);
  EXPECT_EQ(seen.backKind, FaceKind::Measured);
}

TEST(OnWall, ThingsTooFlatToStandOutAreMeasuredToo)
{
  const Seen seen = lookAtPicture(0.01, 0.0012);
  ASSERT_TRUE(seen.measurement.complete) << seen.measurement.reason;
  EXPECT_EQ(seen.measurement.reason, "flat on its wall");
  EXPECT_NEAR(seen.front, kWall - 0.01, 0.002);
  EXPECT_NEAR(seen.back - seen.front, 0.016, 1e-9) << "the least that is measured";
  EXPECT_NEAR(seen.width, 0.6, 0.02);
  EXPECT_NEAR(seen.height, 0.45, 0.02);
}

TEST(OnWall, ThingsOnAWallThatTheSegmentationMissesAreMeasuredToo)
{
  for (const double noise : {0.007, 0.008, 0.009, 0.010})  // at the wall 5 to 7 cm
  {
    const Seen seen = lookAtPicture(0.02, noise);
    ASSERT_TRUE(seen.measurement.complete) << noise << ": " << seen.measurement.reason;
    EXPECT_EQ(seen.measurement.reason, "flat on its wall") << noise;
    EXPECT_NEAR(seen.front, kWall - 0.02, 0.04) << noise;
    EXPECT_NEAR(seen.width, 0.6, 0.03) << noise;
    EXPECT_NEAR(seen.height, 0.45, 0.03) << noise;
    const double sigma = seen.measurement.complete->yawSigma;
    EXPECT_GT(sigma, 0.015) << noise << ": that of a wall of the segmentation is 0.01";
    EXPECT_LT(sigma, 0.06) << noise;
    EXPECT_LT(std::abs(seen.turned), 2 * sigma) << noise;
  }
}

TEST(OnWall, WhatStandsOnATableBeforeAWallEndsBeforeIt)
{
  SyntheticFrame frame(1.5, 0.3);
  frame.noise = 0.0012;
  frame.add(kWall + 0.05, 0.0, 0.0, 0.0, {0.1, 5.0, 2.6});
  frame.add(kWall - 0.4, 0.0, 0.0, 0.0, {0.8, 1.6, 0.75});
  frame.add(kWall - 0.2, 0.1, 0.75, 0.0, {0.1, 0.6, 0.5});
  const Seen seen = look(frame, frame.scan(), frame.detect(2, "picture"));
  ASSERT_TRUE(seen.measurement.complete) << seen.measurement.reason;
  EXPECT_NEAR(seen.front, kWall - 0.25, 0.01);
  EXPECT_LT(seen.back, kWall - 0.05);
}

}  // namespace quadmap
