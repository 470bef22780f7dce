#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

// What is cut out of a box as the object, seen from outside: by the cuboid that comes of it.

namespace quadmap
{
namespace
{
using Scan = mrpt::obs::CObservation3DRangeScan;

std::vector<ObjectMeasurement> measureAll(
    const SyntheticFrame& frame, const std::vector<DetectedObject>& detections, const Scan& scan)
{
  CObservationObjects boxes = frame.observation(detections);
  FramePerception(PerceptionOptions(), LabelTable::installed())
      .measure(scan, boxes, frame.up_sensor());
  std::vector<ObjectMeasurement> out;
  for (const auto& object : boxes.objects) out.push_back(object.measurement);
  return out;
}

/** A detector's box around several boxes of the frame that make one thing. */
DetectedObject detectParts(
    const SyntheticFrame& frame, const std::vector<std::size_t>& parts, const std::string& label)
{
  DetectedObject out = frame.detect(parts.front(), label);
  for (const std::size_t part : parts)
  {
    const ImageBox box = frame.detect(part, label).box;
    out.box = {
        std::min(out.box.x1, box.x1), std::min(out.box.y1, box.y1), std::max(out.box.x2, box.x2),
        std::max(out.box.y2, box.y2)};
  }
  return out;
}

/** Bounds of a measured cuboid along the world's axes [m]. */
Eigen::AlignedBox3d boundsInWorld(const SyntheticFrame& frame, const ObjectMeasurement& m)
{
  Eigen::AlignedBox3d out;
  const auto corners = m.complete->object_sensor.transformed(frame.T_world_sensor).cuboidCorners();
  for (int i = 0; i < 8; ++i) out.extend(Eigen::Vector3d(corners.col(i)));
  return out;
}

TEST(ObjectCloud, CountsACupOnATableToTheCupOnly)
{
  SyntheticFrame frame;
  frame.noise = 0.0015;
  frame.add(1.9, 0.0, 0.0, 0.2, {0.8, 1.2, 0.7});
  frame.add(1.8, 0.1, 0.7, 0.5, {0.10, 0.10, 0.14});
  const auto m =
      measureAll(frame, {frame.detect(0, "dining table"), frame.detect(1, "cup")}, frame.scan());
  ASSERT_TRUE(m[0].complete && m[1].complete) << m[0].reason << "; " << m[1].reason;
  EXPECT_NEAR(boundsInWorld(frame, m[0]).max().z(), 0.70, 0.02) << "the table ends below the cup";
  EXPECT_NEAR(boundsInWorld(frame, m[1]).min().z(), 0.70, 0.02);
}

TEST(ObjectCloud, TellsTwoBooksSideBySideApart)
{
  SyntheticFrame frame(1.2, 0.6);
  frame.noise = 0.001;
  frame.add(1.4, 0.0, 0.0, 0.0, {0.7, 1.2, 0.7});
  frame.add(1.3, 0.12, 0.7, 0.0, {0.24, 0.18, 0.05});
  frame.add(1.3, -0.12, 0.7, 0.0, {0.24, 0.18, 0.05});
  const auto m =
      measureAll(frame, {frame.detect(1, "book"), frame.detect(2, "book")}, frame.scan());
  ASSERT_TRUE(m[0].complete && m[1].complete) << m[0].reason << "; " << m[1].reason;
  EXPECT_NEAR(boundsInWorld(frame, m[0]).center().y(), 0.12, 0.02);
  EXPECT_NEAR(boundsInWorld(frame, m[1]).center().y(), -0.12, 0.02);
  for (const auto& one : m) EXPECT_NEAR(boundsInWorld(frame, one).sizes().y(), 0.18, 0.03);
}

TEST(ObjectCloud, DoesNotTakeTheEndOfATouchingThingForASide)
{
  SyntheticFrame frame(1.2, 0.6);
  frame.noise = 0.001;
  frame.add(1.4, 0.0, 0.0, 0.0, {0.7, 1.2, 0.7});
  frame.add(1.3, 0.0, 0.7, 0.0, {0.24, 0.30, 0.06});
  frame.add(1.3, -0.25, 0.7, 0.0, {0.12, 0.20, 0.06});  // nobody detects it
  const auto m = measureAll(frame, {frame.detect(1, "book")}, frame.scan());
  ASSERT_TRUE(m[0].complete) << m[0].reason;
  const Ellipsoid cuboid = m[0].complete->object_sensor.transformed(frame.T_world_sensor);
  for (std::size_t f = 0; f < 4; ++f)
  {
    const auto axis = static_cast<Eigen::Index>(f / 2);
    const Eigen::Vector3d n = (f % 2 == 0 ? 1.0 : -1.0) * cuboid.rotation().col(axis);
    const bool towardsOther = n.y() < -0.9;
    EXPECT_EQ(m[0].complete->faces[f].kind == FaceKind::Unknown, towardsOther) << n.transpose();
    const double half = std::abs(n.y()) > 0.5 ? 0.15 : 0.12;
    const double end =
        n.dot(cuboid.center() - Eigen::Vector3d(1.3, 0, 0.73)) + cuboid.semiAxes()[axis];
    if (!towardsOther)
    {
      EXPECT_NEAR(end, half, 0.01) << n.transpose();
    }
  }
}

TEST(ObjectCloud, LeavesTheThingInFrontToTheBoxItSuits)
{
  SyntheticFrame frame;
  frame.noise = 0.0015;
  frame.add(1.6, 0.15, 0.0, 0.0, {0.3, 0.4, 0.9});  // hides most of what stands behind
  frame.add(3.0, 0.45, 0.0, 0.0, {0.3, 0.5, 0.9});
  const auto front = frame.detect(0, "chair");
  auto behind = frame.detect(1, "suitcase");
  behind.box.x2 = front.box.x2 - 20;  // a detector that guesses the hidden part
  const auto m = measureAll(frame, {behind, front}, frame.scan());
  ASSERT_TRUE(m[1].complete) << m[1].reason;
  EXPECT_NEAR(boundsInWorld(frame, m[1]).center().x(), 1.6, 0.1);
  if (m[0].complete)
  {
    EXPECT_GT(boundsInWorld(frame, m[0]).center().x(), 2.5);
  }
}

TEST(ObjectCloud, TakesNoHeightOfAFrontForItsTop)
{
  for (const char* label : {"nightstand", "washing machine", "coffee table"})
  {
    SyntheticFrame frame(1.5, 0.2);
    frame.noise = 0.002;
    frame.add(2.2, 0.0, 0.0, 0.0, {0.5, 0.6, 1.9});  // higher than the camera and than its label
    const auto m = measureAll(frame, {frame.detect(0, label)}, frame.scan());
    ASSERT_TRUE(m[0].complete) << label << ": " << m[0].reason;
    EXPECT_GT(boundsInWorld(frame, m[0]).max().z(), 1.5) << label;
  }
}

TEST(ObjectCloud, JoinsTheFrontOfAChairWhoseSeatIsSeenEdgeOn)
{
  SyntheticFrame frame(0.44, 0.0);
  frame.noise = 0.0015;
  frame.add(2.0, 0.0, 0.38, 0.0, {0.44, 0.44, 0.06});  // its top at the camera's height
  frame.add(2.20, 0.0, 0.44, 0.0, {0.04, 0.44, 0.48});
  frame.add(1.80, 0.20, 0.0, 0.0, {0.04, 0.04, 0.38});
  frame.add(1.80, -0.20, 0.0, 0.0, {0.04, 0.04, 0.38});
  frame.add(3.5, 0.0, 0.0, 0.0, {0.5, 3.0, 1.5});  // background
  const auto m = measureAll(frame, {detectParts(frame, {0, 1, 2, 3}, "chair")}, frame.scan());
  ASSERT_TRUE(m[0].complete) << m[0].reason;
  const auto bounds = boundsInWorld(frame, m[0]);
  EXPECT_NEAR(bounds.min().x(), 1.78, 0.02);
  EXPECT_NEAR(bounds.max().z(), 0.92, 0.03);
}

TEST(ObjectCloud, LeavesAChairBesideATableToItself)
{
  SyntheticFrame frame(1.4, 0.45);
  frame.noise = 0.0015;
  frame.add(2.5, 0.0, 0.70, 0.0, {0.9, 1.2, 0.05});  // top
  std::vector<std::size_t> table = {0};
  for (const double x : {2.1, 2.9})
    for (const double y : {-0.55, 0.55})
    {
      table.push_back(frame.boxes.size());
      frame.add(x, y, 0.0, 0.0, {0.06, 0.06, 0.70});
    }
  frame.add(2.5, 0.71, 0.0, 0.0, {0.06, 0.06, 0.40});  // a leg of a chair, within the table's box
  const auto m = measureAll(frame, {detectParts(frame, table, "dining table")}, frame.scan());
  ASSERT_TRUE(m[0].complete) << m[0].reason;
  const auto bounds = boundsInWorld(frame, m[0]);
  EXPECT_NEAR(bounds.max().y(), 0.60, 0.03);
  EXPECT_NEAR(bounds.min().y(), -0.60, 0.03);
}

// Its headboard reaches as far back as the thing behind it, and the box as far up.
TEST(ObjectCloud, LeavesWhatIsSeenBehindABedThatFillsItsBox)
{
  SyntheticFrame frame(1.3, 0.25);
  frame.noise = 0.0015;
  const double yaw = 0.6;
  const Eigen::Vector2d along(std::cos(yaw), std::sin(yaw)), left(-along.y(), along.x());
  const auto part = [&](double forwards, double sideways, const Eigen::Vector3d& size)
  {
    const Eigen::Vector2d at = Eigen::Vector2d(3.2, 0) + forwards * along + sideways * left;
    frame.add(at.x(), at.y(), 0, yaw, size);
  };
  part(0, 0, {2.0, 1.5, 0.5});
  part(1.02, 0, {0.04, 1.5, 1.0});      // headboard
  part(-0.1, -1.15, {0.3, 0.3, 0.75});  // beyond its right side: nobody detects it
  const auto m = measureAll(frame, {detectParts(frame, {0, 1}, "bed")}, frame.scan());
  ASSERT_TRUE(m[0].complete) << m[0].reason;
  const Ellipsoid cuboid = m[0].complete->object_sensor.transformed(frame.T_world_sensor);
  const Eigen::Vector3d right(-left.x(), -left.y(), 0);
  double farthest = -1e9;
  const auto corners = cuboid.cuboidCorners();
  for (int i = 0; i < 8; ++i)
    farthest = std::max(farthest, right.dot(corners.col(i) - Eigen::Vector3d(3.2, 0, 0)));
  EXPECT_LT(farthest, 0.75 + 0.05);
}

TEST(ObjectCloud, LooksThroughAChairsBack)
{
  SyntheticFrame frame(1.2, 0.35);
  frame.noise = 0.0015;
  frame.add(2.0, 0.0, 0.40, 0.0, {0.44, 0.44, 0.06});   // seat
  frame.add(2.20, 0.20, 0.0, 0.0, {0.04, 0.04, 0.92});  // posts
  frame.add(2.20, -0.20, 0.0, 0.0, {0.04, 0.04, 0.92});
  frame.add(2.20, 0.0, 0.84, 0.0, {0.04, 0.38, 0.08});  // top rail, open below
  frame.add(1.80, 0.20, 0.0, 0.0, {0.04, 0.04, 0.40});  // front legs
  frame.add(1.80, -0.20, 0.0, 0.0, {0.04, 0.04, 0.40});
  frame.add(3.1, 0.0, 0.0, 0.4, {0.5, 2.0, 1.5});  // what shows through the back
  const auto m = measureAll(frame, {detectParts(frame, {0, 1, 2, 3, 4, 5}, "chair")}, frame.scan());
  ASSERT_TRUE(m[0].complete) << m[0].reason;
  const auto bounds = boundsInWorld(frame, m[0]);
  EXPECT_LT(bounds.max().x(), 2.35) << "nothing of the background";
  EXPECT_NEAR(bounds.max().z(), 0.92, 0.04);
  EXPECT_NEAR(bounds.sizes().y(), 0.44, 0.06);
}

TEST(ObjectCloud, JoinsThePotAndTheLeavesOfAThinPlant)
{
  SyntheticFrame frame(1.2, 0.3);
  frame.noise = 0.0015;
  frame.add(2.2, 0.0, 0.0, 0.0, {0.24, 0.24, 0.22});
  frame.add(2.2, 0.0, 0.22, 0.0, {0.008, 0.008, 0.3});  // the stem: one pixel, which is no surface
  frame.add(2.2, 0.0, 0.52, 0.6, {0.3, 0.3, 0.3});
  const auto m = measureAll(frame, {detectParts(frame, {0, 1, 2}, "potted plant")}, frame.scan());
  ASSERT_TRUE(m[0].complete) << m[0].reason;
  const auto bounds = boundsInWorld(frame, m[0]);
  EXPECT_NEAR(bounds.max().z(), 0.82, 0.04);
  EXPECT_NEAR(bounds.min().z(), 0.0, 0.02);
}

TEST(ObjectCloud, MeasuresAScreenByItsFrame)
{
  SyntheticFrame frame(1.1, 0.1);
  frame.noise = 0.0015;
  const double yaw = 0.35;  // of the screen
  const Eigen::Vector2d n(std::cos(yaw), std::sin(yaw)), t(-n.y(), n.x());
  const auto part = [&](double along, double bottom, double width, double height, bool hasDepth)
  {
    const Eigen::Vector2d p = Eigen::Vector2d(2.0, 0.0) + along * t;
    frame.add(p.x(), p.y(), bottom, yaw, {0.05, width, height});
    frame.boxes.back().hasDepth = hasDepth;
  };
  part(0.0, 0.77, 0.86, 0.46, false);  // the panel
  part(0.465, 0.71, 0.07, 0.58, true);
  part(-0.465, 0.71, 0.07, 0.58, true);
  part(0.0, 1.23, 1.0, 0.06, true);
  part(0.0, 0.71, 1.0, 0.06, true);
  frame.add(2.05, 0.0, 0.0, yaw, {0.45, 1.4, 0.71});  // the stand
  const auto m = measureAll(frame, {detectParts(frame, {0, 1, 2, 3, 4}, "tv")}, frame.scan());
  ASSERT_TRUE(m[0].complete) << m[0].reason;
  const Ellipsoid world = m[0].complete->object_sensor.transformed(frame.T_world_sensor);
  EXPECT_TRUE(m[0].complete->yawDefined);
  Eigen::Vector3d sizes = 2 * world.semiAxes();
  if (std::abs(world.rotation().col(0).head<2>().dot(n)) < 0.7) std::swap(sizes.x(), sizes.y());
  EXPECT_NEAR(sizes.y(), 1.0, 0.06);
  EXPECT_NEAR(sizes.z(), 0.58, 0.06);
  EXPECT_LT(sizes.x(), 0.15) << "a screen is thin";
}

TEST(ObjectCloud, IgnoresFlyingPixels)
{
  SyntheticFrame frame;
  frame.noise = 0.0015;
  frame.add(2.0, 0.1, 0.0, 0.3, {0.5, 0.43, 0.6});
  frame.add(3.2, 0.0, 0.0, 0.0, {0.2, 3.0, 2.0});
  auto scan = frame.scan();
  const auto clean = scan.rangeImage;
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int v = 0; v < 480; ++v)
    for (int u = 1; u < 639; ++u)
    {
      const double a = clean(v, u - 1), b = clean(v, u + 1);
      if (std::abs(a - b) < 2000 || uniform(rng) > 0.5) continue;  // 0.2 m
      scan.rangeImage(v, u) = static_cast<std::uint16_t>(a + uniform(rng) * (b - a));
    }
  const auto m = measureAll(frame, {frame.detect(0, "suitcase")}, scan);
  ASSERT_TRUE(m[0].complete) << m[0].reason;
  const Ellipsoid world = m[0].complete->object_sensor.transformed(frame.T_world_sensor);
  EXPECT_LT((world.center() - frame.boxes[0].cuboid.center()).norm(), 0.03);
}

/** The frame with only a share of the depth on one of its boxes, as black surfaces return it. */
Scan blackened(const SyntheticFrame& frame, int box, double share)
{
  auto scan = frame.scan();
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (unsigned v = 0; v < 480; ++v)
    for (unsigned u = 0; u < 640; ++u)
      if (frame.look(u, v).first == box && uniform(rng) > share)
        scan.rangeImage(static_cast<int>(v), static_cast<int>(u)) = 0;
  return scan;
}

TEST(ObjectCloud, MeasuresABlackThingByTheFewPointsItGives)
{
  SyntheticFrame frame;
  frame.noise = 0.0015;
  frame.add(2.0, 0.1, 0.0, 0.3, {0.5, 0.43, 0.6});
  const auto m = measureAll(frame, {frame.detect(0, "suitcase")}, blackened(frame, 0, 0.4));
  ASSERT_TRUE(m[0].complete) << m[0].reason;
  const Ellipsoid world = m[0].complete->object_sensor.transformed(frame.T_world_sensor);
  EXPECT_LT((world.center() - frame.boxes[0].cuboid.center()).norm(), 0.04);
}

TEST(ObjectCloud, SaysSoWhenABlackThingGivesTooLittle)
{
  SyntheticFrame frame;
  frame.add(2.0, 0.1, 0.0, 0.3, {0.5, 0.43, 0.6});
  const auto m = measureAll(frame, {frame.detect(0, "suitcase")}, blackened(frame, 0, 0.01));
  EXPECT_FALSE(m[0].complete);
  EXPECT_FALSE(m[0].reason.empty());
}

TEST(ObjectCloud, CallsASurfaceThatGoesOnOutsideItsBoxIncomplete)
{
  SyntheticFrame frame(1.2, 0.2);
  frame.noise = 0.0015;
  frame.add(2.0, 0.0, 0.0, 0.0, {0.4, 1.6, 1.6});
  DetectedObject detection;
  detection.label = "suitcase";
  detection.box = {220, 150, 420, 330};  // in the middle of a large front
  EXPECT_FALSE(measureAll(frame, {detection}, frame.scan())[0].complete);
}

TEST(ObjectCloud, UsesAMaskWhoseBoundaryIsABitOff)
{
  for (const int shift : {-3, 3})  // [px]: the mask is shifted into the neighbour, and out of it
  {
    SyntheticFrame frame;
    frame.noise = 0.0015;
    frame.add(2.0, 0.00, 0.0, 0.0, {0.4, 0.4, 0.5});
    frame.add(2.0, 0.41, 0.0, 0.0, {0.4, 0.4, 0.5});
    DetectedObject detection = frame.detect(0, "suitcase");
    ObjectMask mask;
    mask.width = 640;
    mask.height = 480;
    std::vector<std::uint8_t> pixels(640 * 480, 0);
    for (unsigned v = 0; v < 480; ++v)
      for (unsigned u = 4; u < 636; ++u)
        if (frame.look(u, v).first == 0)
          pixels[v * 640 + static_cast<unsigned>(static_cast<int>(u) + shift)] = 1;
    mask.pixels = pixels;
    detection.mask = mask;
    const auto m = measureAll(frame, {detection}, frame.scan());
    ASSERT_TRUE(m[0].complete) << m[0].reason;
    const Ellipsoid world = m[0].complete->object_sensor.transformed(frame.T_world_sensor);
    // Three pixels are 11 mm at 2 m.
    EXPECT_LT((world.center() - frame.boxes[0].cuboid.center()).norm(), 0.025) << shift;
  }
}

}  // namespace
}  // namespace quadmap
