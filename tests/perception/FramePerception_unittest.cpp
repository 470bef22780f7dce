#include "quadmap/perception/FramePerception.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../obs/InstalledLabels.h"
#include "../surfaces/SyntheticFrame.h"
#include "quadmap/geometry/Overlap.h"
#include "quadmap/geometry/RotationDistance.h"

namespace quadmap
{
namespace
{
/** Measures one box of a frame. */
ObjectMeasurement measured(
    const SyntheticFrame& frame,
    const DetectedObject& detection,
    const PerceptionOptions& options = {},
    bool withUp = true)
{
  CObservationObjects boxes = frame.observation({detection});
  const auto up = withUp ? std::optional<Eigen::Vector3d>(frame.up_sensor()) : std::nullopt;
  FramePerception(options, labels()).measure(frame.scan(), boxes, up);
  return boxes.objects.front().measurement;
}

/** How far a measurement is from the truth, for objects standing at an angle of up to 45 degrees.
 */
struct Difference
{
  double center = 0, rotation = 0, shapeIoU = 0;  // [m], [rad], [-]
};

Difference compare(
    const SyntheticFrame& frame, const CompleteMeasurement& complete, const Ellipsoid& truth)
{
  const Ellipsoid world = complete.object_sensor.transformed(frame.T_world_sensor);
  const auto rotation = symmetricRotationDistance(truth.rotation(), world.rotation());
  const Eigen::Vector3d sizes = (rotation.relabeling.transpose() * world.semiAxes()).cwiseAbs();
  return {
      (world.center() - truth.center()).norm(), rotation.angle,
      alignedIoU(sizes, truth.semiAxes())};
}

TEST(FramePerception, MeasuresACabinetOnTheFloorAtAnyYaw)
{
  for (const double yaw_deg : {-30.0, 10.0, 35.0, 60.0})
  {
    SyntheticFrame frame;
    frame.noise = 0.0015;
    frame.add(2.0, 0.1, 0.0, yaw_deg * M_PI / 180, {0.78, 0.43, 0.56});
    const auto m = measured(frame, frame.detect(0, "suitcase"));
    ASSERT_EQ(m.kind, MeasurementKind::Complete) << m.reason;
    const auto d = compare(frame, *m.complete, frame.boxes[0].cuboid);
    // Half a cell of the working resolution is 4 mm here, silhouettes give one or two of them.
    EXPECT_LT(d.center, 0.02) << "yaw " << yaw_deg;
    EXPECT_LT(d.rotation, 1.0 * M_PI / 180) << "yaw " << yaw_deg;
    EXPECT_GT(d.shapeIoU, 0.92) << "yaw " << yaw_deg;
    EXPECT_EQ(m.complete->faces[5].kind, FaceKind::Support);
    EXPECT_TRUE(m.complete->yawDefined);
  }
}

TEST(FramePerception, ClaimsLessOfAnImageThatIsNoisier)
{
  const auto sigmasOfFaces = [](double noise, double most)
  {
    SyntheticFrame frame;
    frame.noise = noise;
    frame.add(2.0, 0.1, 0.0, 0.2, {0.78, 0.43, 0.56});
    PerceptionOptions options;
    options.maxDepthNoiseFactor = most;
    const auto m = measured(frame, frame.detect(0, "suitcase"), options);
    EXPECT_TRUE(m.complete) << m.reason;
    double sigma = 0;
    for (const auto& face : m.complete.value().faces)
      if (face.kind == FaceKind::Measured) sigma += face.sigma;
    return sigma;
  };
  EXPECT_GT(sigmasOfFaces(0.004, 4), 1.1 * sigmasOfFaces(0.004, 1));
  EXPECT_EQ(sigmasOfFaces(0.001, 4), sigmasOfFaces(0.001, 1)) << "less noise than a Kinect's";
}

TEST(FramePerception, FindsUpFromTheFloorWhenNobodyKnowsIt)
{
  SyntheticFrame frame;
  frame.noise = 0.0015;
  frame.add(2.0, 0.1, 0.0, 0.3, {0.78, 0.43, 0.56});
  const auto m = measured(frame, frame.detect(0, "suitcase"), {}, false);
  ASSERT_EQ(m.kind, MeasurementKind::Complete) << m.reason;
  EXPECT_LT(compare(frame, *m.complete, frame.boxes[0].cuboid).center, 0.02);
}

TEST(FramePerception, WorksForACameraThatLiesOnItsSide)
{
  SyntheticFrame frame;  // rolled by 90 degrees: the image's y axis is horizontal
  frame.T_world_sensor = mrpt::poses::CPose3D(0, 0, 1.3, 0, 0.45, M_PI / 2);
  frame.add(2.0, 0.0, 0.0, 0.3, {0.6, 0.43, 0.56});
  const auto m = measured(frame, frame.detect(0, "suitcase"));
  ASSERT_EQ(m.kind, MeasurementKind::Complete) << m.reason;
  EXPECT_LT(compare(frame, *m.complete, frame.boxes[0].cuboid).center, 0.02);
}

TEST(FramePerception, PutsAThingOnTheTableItStandsOn)
{
  SyntheticFrame frame;
  frame.add(1.8, 0.0, 0.0, 0.2, {0.8, 1.2, 0.7});
  frame.add(1.7, 0.1, 0.7, 0.5, {0.12, 0.12, 0.12});
  const auto m = measured(frame, frame.detect(1, "cup"));
  ASSERT_EQ(m.kind, MeasurementKind::Complete) << m.reason;
  const Ellipsoid world = m.complete->object_sensor.transformed(frame.T_world_sensor);
  EXPECT_NEAR(world.center().z() - world.semiAxes().z(), 0.70, 0.01) << "bottom on the table top";
  EXPECT_FALSE(m.complete->yawDefined) << "cups have no dominant direction";
  EXPECT_LT((world.center() - frame.boxes[1].cuboid.center()).norm(), 0.03);
}

TEST(FramePerception, LeavesAChairBehindATableOnTheFloor)
{
  SyntheticFrame frame;
  frame.add(1.8, 0.0, 0.0, 0.0, {0.7, 1.6, 0.72});
  frame.add(2.6, 0.1, 0.0, 0.1, {0.45, 0.45, 0.95});
  frame.add(3.5, 2.0, 0.0, 0.0, {0.3, 0.3, 0.3});
  const auto m = measured(frame, frame.detect(1, "chair"));
  ASSERT_EQ(m.kind, MeasurementKind::Complete) << m.reason;
  const Ellipsoid world = m.complete->object_sensor.transformed(frame.T_world_sensor);
  EXPECT_NEAR(world.center().z() - world.semiAxes().z(), 0.0, 0.03);
  EXPECT_EQ(m.edges->at(3).state, EdgeState::Occluded) << "the table hides its lower edge";
}

TEST(FramePerception, UsesAFloorKnownFromOtherFrames)
{
  SyntheticFrame frame;
  frame.hasFloor = false;
  frame.add(1.8, 0.0, 0.0, 0.3, {0.5, 0.5, 0.9});
  CObservationObjects boxes = frame.observation({frame.detect(0, "chair")});
  const SurfacePatch floor = {
      SurfaceKind::Floor, {Eigen::Vector3d::UnitZ(), 0.0},
       {     }
  };
  FramePerception(PerceptionOptions(), labels())
      .measure(frame.scan(), boxes, frame.up_sensor(), {transformed(floor, -frame.T_world_sensor)});
  const auto& m = boxes.objects[0].measurement;
  ASSERT_EQ(m.kind, MeasurementKind::Complete) << m.reason;
  EXPECT_EQ(m.complete->faces[5].kind, FaceKind::Support);
  const Ellipsoid world = m.complete->object_sensor.transformed(frame.T_world_sensor);
  EXPECT_NEAR(world.center().z() - world.semiAxes().z(), 0.0, 0.005);
}

TEST(FramePerception, ReturnsTheFloorItSaw)
{
  SyntheticFrame frame;
  frame.add(2.0, 0.1, 0.0, 0.3, {0.78, 0.43, 0.56});
  CObservationObjects boxes = frame.observation({frame.detect(0, "suitcase")});
  const auto surfaces = FramePerception(PerceptionOptions(), labels())
                            .measure(frame.scan(), boxes, frame.up_sensor());
  ASSERT_FALSE(surfaces.seen.empty());
  EXPECT_EQ(surfaces.seen.front().kind, SurfaceKind::Floor) << "the lowest comes first";
  const SurfacePatch world = transformed(surfaces.seen.front(), frame.T_world_sensor);
  EXPECT_GT(world.plane.n.z(), std::cos(0.5 * M_PI / 180));
  EXPECT_NEAR(world.plane.d, 0.0, 0.01);
  EXPECT_GT(world.samples.size(), 100U);
  for (const auto& p : world.samples) EXPECT_NEAR(p.z(), 0.0, 0.02);
}

TEST(FramePerception, CallsTheHiddenBackOfAFrontalBoxALowerBound)
{
  SyntheticFrame frame(0.9, 0.0);  // eye level below the top: only the front face shows
  frame.add(2.5, 0.0, 0.0, 0.0, {0.6, 0.7, 1.7});
  const auto m = measured(frame, frame.detect(0, "refrigerator"));
  ASSERT_TRUE(m.complete) << m.reason;
  const Ellipsoid world = m.complete->object_sensor.transformed(frame.T_world_sensor);
  for (std::size_t f = 0; f < 4; ++f)
  {
    const Eigen::Vector3d n = (f % 2 == 0 ? 1 : -1) * world.rotation().col(static_cast<int>(f / 2));
    if (n.x() > 0.9)
    {
      EXPECT_EQ(m.complete->faces[f].kind, FaceKind::AtLeast);
    }
    if (n.x() < -0.9)
    {
      EXPECT_EQ(m.complete->faces[f].kind, FaceKind::Measured);
    }
  }
}

/** How many sides of a chair are measured of which only the upper half, box 0, is seen.
 * \param foot Its lower half: the detector's box is around both. */
long measuredSides(const SyntheticFrame& frame, const Ellipsoid& foot)
{
  DetectedObject chair = frame.detect(0, "chair");
  const auto lower = *projectCuboidBox(
      pinholeFrom(frame.camera),
      foot.transformed(-frame.T_world_sensor).transformed(-T_sensor_optical()));
  chair.box = {
      std::min(chair.box.x1, lower.x1), chair.box.y1, std::max(chair.box.x2, lower.x2), lower.y2};
  const auto m = measured(frame, chair);
  EXPECT_TRUE(m.complete) << m.reason;
  if (!m.complete) return 0;
  return std::count_if(
      m.complete->faces.begin(), m.complete->faces.begin() + 4,
      [](const auto& face) { return face.kind == FaceKind::Measured; });
}

TEST(FramePerception, MeasuresNoSideOfWhatStandsOnABlackFoot)
{
  SyntheticFrame inSight(1.7, 0.5), hidden(1.7, 0.5);
  for (auto* frame : {&inSight, &hidden}) frame->add(2.3, 0.0, 0.45, 0.4, {0.45, 0.45, 0.45});
  inSight.add(2.3, 0.0, 0.0, 0.4, {0.46, 0.46, 0.44});
  inSight.boxes[1].hasDepth = false;
  hidden.add(1.7, 0.0, 0.0, 0.0, {0.3, 1.6, 0.6});
  EXPECT_EQ(measuredSides(inSight, inSight.boxes[1].cuboid), 0) << "it may reach out";
  EXPECT_GT(measuredSides(hidden, inSight.boxes[1].cuboid), 0) << "behind a table";
}

TEST(FramePerception, CallsASideCutByTheImageALowerBound)
{
  SyntheticFrame frame;
  frame.add(2.0, 1.1, 0.0, 0.0, {0.6, 0.8, 0.7});  // reaches beyond the left image border
  const auto m = measured(frame, frame.detect(0, "suitcase"));
  ASSERT_TRUE(m.complete) << m.reason;
  EXPECT_EQ(m.edges->at(0).state, EdgeState::NearImageBorder);
  const Ellipsoid world = m.complete->object_sensor.transformed(frame.T_world_sensor);
  for (std::size_t f = 0; f < 4; ++f)
  {
    const Eigen::Vector3d n = (f % 2 == 0 ? 1 : -1) * world.rotation().col(static_cast<int>(f / 2));
    if (n.y() > 0.9)
    {
      EXPECT_EQ(m.complete->faces[f].kind, FaceKind::AtLeast);
    }
  }
}

TEST(FramePerception, FallsBackToBoxEdgesWithoutDepth)
{
  SyntheticFrame frame;
  frame.add(2.0, 0.0, 0.6, 0.0, {0.05, 0.8, 0.5});
  frame.boxes[0].hasDepth = false;
  const auto detection = frame.detect(0, "tv");
  const auto m = measured(frame, detection);
  ASSERT_EQ(m.kind, MeasurementKind::Partial) << m.reason;
  ASSERT_TRUE(m.edges);
  EXPECT_FALSE(m.complete);
  // Each edge's plane touches the object: the nearest of its corners, to a pixel at 2 m.
  for (const auto& edge : *m.edges)
  {
    EXPECT_EQ(edge.state, EdgeState::Usable);
    const auto corners = frame.boxes[0].cuboid.transformed(-frame.T_world_sensor).cuboidCorners();
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i)
      nearest = std::min(nearest, edge.plane_sensor.signedDistance(corners.col(i)));
    EXPECT_NEAR(nearest, 0.0, 2.0 / 525 * 1.5);
  }
}

TEST(FramePerception, TakesNotWhatIsBehindAScreenForTheScreen)
{
  SyntheticFrame frame(1.2, 0.1);
  frame.add(2.0, 0.0, 0.9, 0.0, {0.04, 0.6, 0.35});
  frame.add(2.0, 0.0, 0.7, 0.0, {0.04, 0.12, 0.2});  // its foot
  for (auto& box : frame.boxes) box.hasDepth = false;
  frame.add(1.97, 0.0, 0.9, 0.0, {0.02, 0.6, 0.02});  // the lower part of its frame
  frame.add(2.0, 0.0, 0.0, 0.0, {0.7, 1.6, 0.7});     // the desk it stands on
  frame.add(2.7, 0.05, 0.0, 0.0, {0.2, 0.9, 0.85});   // something behind, that shows under it
  DetectedObject tv = frame.detect(0, "tv");
  tv.box.y2 = frame.detect(1, "tv").box.y2;
  const auto m = measured(frame, tv);
  ASSERT_EQ(m.kind, MeasurementKind::Partial) << m.reason;
  ASSERT_TRUE(m.seed_sensor);
  EXPECT_NEAR(m.seed_sensor->x(), 2.0, 0.25);
}

TEST(FramePerception, UsesAMaskToTellAnObjectFromWhatTouchesIt)
{
  SyntheticFrame frame;
  frame.add(2.0, 0.00, 0.0, 0.0, {0.4, 0.4, 0.5});
  frame.add(2.0, 0.41, 0.0, 0.0, {0.4, 0.4, 0.5});
  DetectedObject detection = frame.detect(0, "suitcase");
  detection.box.x1 -= 40;  // a loose box that shows a part of the neighbour
  ObjectMask mask;
  mask.x0 = static_cast<unsigned>(detection.box.x1);
  mask.y0 = static_cast<unsigned>(detection.box.y1);
  mask.width = static_cast<unsigned>(detection.box.width()) + 1;
  mask.height = static_cast<unsigned>(detection.box.height()) + 1;
  for (unsigned v = 0; v < mask.height; ++v)
    for (unsigned u = 0; u < mask.width; ++u)
      mask.pixels.push_back(frame.look(mask.x0 + u, mask.y0 + v).first == 0 ? 1 : 0);
  detection.mask = mask;
  PerceptionOptions options;
  options.minCompleteIoU = 0.5;  // the loose box is the point here
  const auto m = measured(frame, detection, options);
  ASSERT_TRUE(m.complete) << m.reason;
  const auto d = compare(frame, *m.complete, frame.boxes[0].cuboid);
  EXPECT_LT(d.center, 0.02);
}

TEST(FramePerception, MirrorsWithANegativeFocalLength)
{
  SyntheticFrame frame;
  frame.camera.fy(-525);  // ICL-NUIM: rows run upwards
  frame.add(2.0, 0.1, 0.0, 0.3, {0.78, 0.43, 0.56});
  const auto m = measured(frame, frame.detect(0, "suitcase"));
  ASSERT_EQ(m.kind, MeasurementKind::Complete) << m.reason;
  EXPECT_LT(compare(frame, *m.complete, frame.boxes[0].cuboid).center, 0.02);
}

TEST(FramePerception, TellsWhatItsEdgesAreJudgedBy)
{
  SyntheticFrame frame;
  frame.add(2.0, 0.1, 0.0, 0.2, {0.5, 0.5, 0.5});
  frame.add(1.2, 0.3, 0.0, 0.2, {0.2, 0.2, 0.3});  // hides a part of the first
  DetectedObject outside = frame.detect(0, "suitcase");
  outside.box = {-50, 10, -20, 40};
  CObservationObjects boxes =
      frame.observation({frame.detect(0, "suitcase"), frame.detect(1, "suitcase"), outside});
  const PerceptionOptions options;
  const FramePerception perception(options, labels());
  const auto evidence = perception.edgeEvidence(frame.scan(), boxes, frame.up_sensor());
  perception.measure(frame.scan(), boxes, frame.up_sensor());
  ASSERT_EQ(evidence.size(), 3u);
  EXPECT_FALSE(evidence[2]);
  int hidden = 0, usable = 0;
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t e = 0; e < 4; ++e)
    {
      const EdgeEvidence& edge = evidence[b].value()[e];
      const bool isUsable = !edge.isRefused && hiddenProbability(edge.side, edge.hidden) <=
                                                   options.maxHiddenProbability;
      EXPECT_EQ(boxes.objects[b].measurement.edges.value()[e].state == EdgeState::Usable, isUsable)
          << b << ' ' << e;
      ++(isUsable ? usable : hidden);
    }
  EXPECT_GT(hidden, 0);
  EXPECT_GT(usable, 0);
}

TEST(FramePerception, RejectsBoxesThatShowNothing)
{
  SyntheticFrame frame;
  frame.add(2.0, 0.1, 0.0, 0.3, {0.78, 0.43, 0.56});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ImageBox bad[] = {
      {100, 100, 100, 200},
      {200, 200, 100, 100},
      {700, 500, 800, 600},
      {nan,  10,  50,  60}
  };
  for (const auto& box : bad)
  {
    DetectedObject detection;
    detection.label = "chair";
    detection.box = box;
    const auto m = measured(frame, detection);
    EXPECT_EQ(m.kind, MeasurementKind::Rejected);
    EXPECT_FALSE(m.reason.empty());
  }
}

TEST(FramePerception, SaysWhyWhenThereIsNoDepthAtAll)
{
  SyntheticFrame frame;
  frame.add(2.0, 0.1, 0.0, 0.3, {0.78, 0.43, 0.56});
  auto scan = frame.scan();
  scan.rangeImage.setZero();
  CObservationObjects boxes = frame.observation({frame.detect(0, "suitcase")});
  FramePerception(PerceptionOptions(), labels()).measure(scan, boxes, frame.up_sensor());
  EXPECT_EQ(boxes.objects[0].measurement.kind, MeasurementKind::Partial);
  EXPECT_EQ(boxes.objects[0].measurement.reason, "no depth in the box");
  EXPECT_FALSE(boxes.objects[0].measurement.seed_sensor);
}

TEST(FramePerception, RefusesScansItCannotUse)
{
  SyntheticFrame frame;
  CObservationObjects boxes = frame.observation({});
  const FramePerception perception{PerceptionOptions(), labels()};
  EXPECT_THROW(
      perception.measure(mrpt::obs::CObservation3DRangeScan(), boxes, {}), std::runtime_error);
  auto scan = frame.scan();
  scan.cameraParams.fx(0);
  EXPECT_THROW(perception.measure(scan, boxes, {}), std::runtime_error);
}

TEST(FramePerception, GivesTheSameForTheSameFrame)
{
  SyntheticFrame frame;
  frame.noise = 0.0015;
  frame.add(2.0, 0.1, 0.0, 0.3, {0.78, 0.43, 0.56});
  const auto a = measured(frame, frame.detect(0, "suitcase"));
  const auto b = measured(frame, frame.detect(0, "suitcase"));
  ASSERT_TRUE(a.complete && b.complete);
  EXPECT_EQ(a.complete->object_sensor.center(), b.complete->object_sensor.center());
  EXPECT_EQ(a.complete->object_sensor.semiAxes(), b.complete->object_sensor.semiAxes());
}

TEST(FramePerception, FillsTheCoarseDepth)
{
  SyntheticFrame frame;
  CObservationObjects boxes = frame.observation({});
  FramePerception(PerceptionOptions(), labels()).measure(frame.scan(), boxes, frame.up_sensor());
  const auto& coarse = boxes.coarseDepth;
  ASSERT_EQ(coarse.depth.size(), coarse.columns * coarse.rows);
  const unsigned column = coarse.columns / 2, row = 3 * coarse.rows / 4;
  const unsigned u = (2 * column + 1) * 640 / (2 * coarse.columns);
  const unsigned v = (2 * row + 1) * 480 / (2 * coarse.rows);
  EXPECT_NEAR(coarse.depth[row * coarse.columns + column], frame.look(u, v).second, 0.03);
}

}  // namespace
}  // namespace quadmap
