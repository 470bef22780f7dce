#include <gtest/gtest.h>

#include <string>

#include "../../obs/InstalledLabels.h"
#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

namespace quadmap
{
namespace
{
using mrpt::obs::CObservation3DRangeScan;

const Eigen::Vector3d kSuitcaseSize(0.45, 0.5, 0.6);  // [m]

/** A suitcase on the floor, 2.2 m ahead. */
SyntheticFrame frameWithSuitcase()
{
  SyntheticFrame frame;
  frame.add(2.2, 0.0, 0.0, 0.4, kSuitcaseSize);
  return frame;
}

/** One letter per edge left, top, right, bottom: u usable, b near the border, o occluded;
 * "rejected" when there is none. */
std::string edgesOf(const ObjectMeasurement& m)
{
  if (!m.edges) return "rejected";
  std::string out;
  for (const auto& edge : *m.edges)
    out += edge.state == EdgeState::Usable            ? 'u'
           : edge.state == EdgeState::NearImageBorder ? 'b'
                                                      : 'o';
  return out;
}

/** Measures boxes of a frame. \return Of the first one. */
ObjectMeasurement measured(
    const SyntheticFrame& frame,
    const std::vector<DetectedObject>& detections,
    const PerceptionOptions& options = {})
{
  CObservationObjects boxes = frame.observation(detections);
  FramePerception(options, labels()).measure(frame.scan(), boxes, frame.up_sensor());
  return boxes.objects.front().measurement;
}

TEST(EdgeRules, AllEdgesOfAFreeObjectAreUsable)
{
  const auto frame = frameWithSuitcase();
  EXPECT_EQ(edgesOf(measured(frame, {frame.detect(0, "suitcase")})), "uuuu");
}

TEST(EdgeRules, AnEdgeBehindSomethingNearerIsOccluded)
{
  auto frame = frameWithSuitcase();
  frame.add(1.3, -0.28, 0.0, 0.0, {0.1, 0.5, 0.9});  // hides its right part
  const std::string edges = edgesOf(measured(frame, {frame.detect(0, "suitcase")}));
  EXPECT_EQ(edges[2], 'o') << edges;
  EXPECT_EQ(edges[1], 'u') << edges;
}

TEST(EdgeRules, AThinThingInFrontHidesNoEdge)
{
  auto frame = frameWithSuitcase();
  frame.add(1.3, 0.0, 0.0, 0.0, {0.03, 0.03, 1.0});  // a pole before its middle
  EXPECT_EQ(edgesOf(measured(frame, {frame.detect(0, "suitcase")})), "uuuu");
}

TEST(EdgeRules, WhatStandsBehindATableHasNoBottomEdge)
{
  SyntheticFrame frame;
  frame.add(2.6, 0.0, 0.0, 0.0, {0.45, 0.45, 0.95});
  frame.add(1.3, 0.0, 0.70, 0.0, {1.2, 1.6, 0.04});  // the table top
  const std::string edges = edgesOf(measured(frame, {frame.detect(0, "chair")}));
  EXPECT_EQ(edges[3], 'o') << edges;
}

// The table leads up to the chair that was pushed under it, and nobody knows where the floor is.
TEST(EdgeRules, WhatStandsAtATableOnAnUnseenFloorHasNoLowerEdges)
{
  for (const double roll : {0.0, 0.7})
  {
    SyntheticFrame frame;
    frame.T_world_sensor = mrpt::poses::CPose3D(0, 0, 1.5, 0, 0.45, roll);
    frame.hasFloor = false;
    frame.add(2.35, 0.0, 0.0, 0.0, {0.05, 0.45, 0.9});  // of the chair its back is seen
    frame.add(1.91, 0.0, 0.0, 0.0, {0.8, 1.6, 0.72});
    const auto chair = measured(frame, {frame.detect(0, "chair")});
    ASSERT_TRUE(chair.edges) << chair.reason;
    int lower = 0;
    for (const auto& edge : *chair.edges)
    {
      if (edge.plane_sensor.n.dot(frame.up_sensor()) < 0.55) continue;
      ++lower;
      EXPECT_EQ(edge.state, EdgeState::Occluded) << roll;
    }
    EXPECT_EQ(lower, roll == 0 ? 1 : 2);
  }
}

// What hides it returns no depth, and no detector knows it: nothing but the box, which ends far
// above the floor, tells.
TEST(EdgeRules, ABoxThatEndsBeforeItsObjectReachesTheSupportHasNoBottomEdge)
{
  auto frame = frameWithSuitcase();
  frame.add(1.6, 0.0, 0.0, 0.0, {0.1, 1.5, 0.45});
  frame.boxes[1].hasDepth = false;
  EXPECT_EQ(edgesOf(measured(frame, {frame.detect(0, "suitcase")})), "uuuo");
}

// From afar the desk is not found as the support, and within the strip below the screen it comes
// much nearer than the screen.
TEST(EdgeRules, ADeskNotHigherThanWhatStandsOnItHidesNothing)
{
  SyntheticFrame frame;
  frame.add(3.5, 0.0, 0.71, 0.0, {0.2, 0.5, 0.5});
  frame.add(3.2, 0.0, 0.67, 0.0, {0.4, 0.62, 0.04});
  const std::string edges = edgesOf(measured(frame, {frame.detect(0, "tv")}));
  EXPECT_EQ(edges[3], 'u') << edges;
}

TEST(EdgeRules, AScreenInFrontOccludesAlthoughItHasNoDepth)
{
  auto frame = frameWithSuitcase();
  frame.add(1.3, -0.28, 0.0, 0.0, {0.1, 0.5, 0.9});
  frame.boxes[1].hasDepth = false;
  // The screen's stand, around which its box finds its depth.
  frame.add(1.28, -0.28, 0.35, 0.0, {0.1, 0.3, 0.3});
  auto screen = frame.detect(1, "tv");
  const std::string edges = edgesOf(measured(frame, {frame.detect(0, "suitcase"), screen}));
  EXPECT_EQ(edges[2], 'o') << edges;
}

TEST(EdgeRules, TheDarkSideOfADepthEdgeSaysNothing)
{
  const auto frame = frameWithSuitcase();
  const auto detection = frame.detect(0, "suitcase");
  CObservation3DRangeScan scan = frame.scan();
  for (int v = 0; v < 480; ++v)  // the projector's shadow on the background
    for (int u = static_cast<int>(detection.box.x1) - 15; u < detection.box.x1; ++u)
      scan.rangeImage(v, u) = 0;
  CObservationObjects boxes = frame.observation({detection});
  FramePerception(PerceptionOptions(), labels()).measure(scan, boxes, frame.up_sensor());
  EXPECT_EQ(edgesOf(boxes.objects[0].measurement), "uuuu");
}

TEST(EdgeRules, AnotherBoxOfTheSameThingHidesNothing)
{
  SyntheticFrame frame;
  frame.add(2.2, 0.0, 0.0, 0.6, {0.4, 1.2, 0.6});  // its far end is half a metre farther away
  const auto detection = frame.detect(0, "couch");
  auto twin = frame.detect(0, "bed");
  twin.box = {twin.box.x1 - 8, twin.box.y1 - 8, twin.box.x2 + 8, twin.box.y2 + 8};
  CObservation3DRangeScan scan = frame.scan();
  for (int v = 0; v < 480; ++v)  // no depth beside it
    for (int du = 1; du <= 12; ++du)
    {
      scan.rangeImage(v, static_cast<int>(detection.box.x1) - du) = 0;
      scan.rangeImage(v, static_cast<int>(detection.box.x2) + du) = 0;
    }
  CObservationObjects boxes = frame.observation({detection, twin});
  FramePerception(PerceptionOptions(), labels()).measure(scan, boxes, frame.up_sensor());
  EXPECT_EQ(edgesOf(boxes.objects[0].measurement), "uuuu");
}

TEST(EdgeRules, AnObjectDoesNotHideItself)
{
  SyntheticFrame frame;
  frame.add(2.6, 0.0, 0.0, 0.0, {0.2, 1.6, 0.8});   // the back of a couch
  frame.add(2.15, 0.0, 0.0, 0.0, {0.7, 1.6, 0.4});  // its seat
  DetectedObject couch = frame.detect(0, "couch");
  const ImageBox seat = frame.detect(1, "couch").box;
  couch.box = {
      std::min(couch.box.x1, seat.x1), std::min(couch.box.y1, seat.y1),
      std::max(couch.box.x2, seat.x2), std::max(couch.box.y2, seat.y2)};
  EXPECT_EQ(edgesOf(measured(frame, {couch})), "uuuu");
}

TEST(EdgeRules, TheMarginAtTheBorderScalesWithTheImage)
{
  struct Case
  {
    unsigned width;
    double distance;  // of the left edge to the border [px]
    char state;
  };
  for (const Case& c : {
           Case{640, 25, 'b'},
           Case{640, 35, 'u'},
           Case{320, 12, 'b'},
           Case{320, 20, 'u'}
  })
  {
    SyntheticFrame frame;  // without any depth: nothing shows that the object ends there
    frame.hasFloor = false;
    const double scale = c.width / 640.0;
    frame.camera.ncols = c.width;
    frame.camera.nrows = c.width * 3 / 4;
    frame.camera.setIntrinsicParamsFromValues(
        525 * scale, 525 * scale, 320 * scale - 0.5, 240 * scale - 0.5);
    DetectedObject box;
    box.label = "suitcase";
    box.box = {c.distance, 150 * scale, 200 * scale, 300 * scale};
    const std::string edges = edgesOf(measured(frame, {box}));
    EXPECT_EQ(edges[0], c.state) << c.width << " " << c.distance << " " << edges;
    EXPECT_EQ(edges[2], 'u') << edges;
  }
}

TEST(EdgeRules, AnObjectThatIsSeenToEndBeforeTheBorderHasItsEdge)
{
  SyntheticFrame frame;
  frame.add(2.2, 0.92, 0.0, 0.0, kSuitcaseSize);
  frame.add(3.4, 1.0, 0.0, 0.0, {0.1, 5.0, 2.5});  // a wall
  const auto detection = frame.detect(0, "suitcase");
  ASSERT_GT(detection.box.x1, 10);
  ASSERT_LT(detection.box.x1, 30);
  EXPECT_EQ(edgesOf(measured(frame, {detection}))[0], 'u');

  SyntheticFrame nearer = frame;
  nearer.boxes[0].cuboid = Ellipsoid(
      {2.2, 1.15, kSuitcaseSize.z() / 2, 0, 0, 0}, kSuitcaseSize / 2);  // goes on beyond the image
  EXPECT_EQ(edgesOf(measured(nearer, {nearer.detect(0, "suitcase")}))[0], 'b');
}

// A picture on a wall: the depth beside it is its own, but a box does not end so far from where the
// border would have cut it.
TEST(EdgeRules, ABoxThatEndsWellBeforeTheBorderIsNotCutByIt)
{
  SyntheticFrame frame;
  frame.add(2.6, 1.1, 1.0, 0.0, {0.03, 0.5, 0.4});
  frame.add(2.7, 1.0, 0.0, 0.0, {0.1, 5.0, 2.5});  // the wall
  const auto distance = [&](double x1)
  {
    auto detection = frame.detect(0, "tv");
    detection.box.x1 = x1;
    return edgesOf(measured(frame, {detection}))[0];
  };
  ASSERT_LT(frame.detect(0, "tv").box.x1, 30);
  EXPECT_EQ(distance(20), 'u');
  EXPECT_EQ(distance(9), 'b');
}

// A bench that comes nearer to the right: its right side runs into the lower border of the image.
TEST(EdgeRules, ASideThatSlantsOutOfTheImageIsNoEdge)
{
  SyntheticFrame frame;
  frame.add(1.4, 0.0, 0.0, 0.4, {2.0, 0.5, 0.4});
  const auto detection = frame.detect(0, "bench");
  ASSERT_LT(detection.box.x2, 600) << "far from the right border";
  EXPECT_EQ(edgesOf(measured(frame, {detection})), "uuob");
}

TEST(EdgeRules, EitherRuleCanBeSwitchedOff)
{
  auto frame = frameWithSuitcase();
  frame.add(1.3, -0.28, 0.0, 0.0, {0.1, 0.5, 0.9});
  PerceptionOptions options;
  options.maxHiddenProbability = 1;
  EXPECT_EQ(edgesOf(measured(frame, {frame.detect(0, "suitcase")}, options)), "uuuu");

  SyntheticFrame cut;
  cut.add(2.2, 1.15, 0.0, 0.0, kSuitcaseSize);
  EXPECT_EQ(edgesOf(measured(cut, {cut.detect(0, "suitcase")}, options))[0], 'b');
  options.borderMargin = 0;
  EXPECT_EQ(edgesOf(measured(cut, {cut.detect(0, "suitcase")}, options))[0], 'u');
}

TEST(EdgeRules, EitherModelCanBeUsedAlone)
{
  const auto frame = frameWithSuitcase();
  const auto detection = frame.detect(0, "suitcase");
  PerceptionOptions options;
  EXPECT_EQ(measured(frame, {detection}, options).kind, MeasurementKind::Complete);
  options.models = ObservationModels::Partial;
  const auto partial = measured(frame, {detection}, options);
  EXPECT_EQ(partial.kind, MeasurementKind::Partial);
  EXPECT_TRUE(partial.seed_sensor);
  EXPECT_EQ(edgesOf(partial), "uuuu");

  options.models = ObservationModels::Complete;
  auto screen = frame;
  screen.boxes[0].hasDepth = false;
  const auto rejected = measured(screen, {detection}, options);
  EXPECT_EQ(rejected.kind, MeasurementKind::Rejected);
  EXPECT_NE(rejected.reason.find("partial models are switched off"), std::string::npos)
      << rejected.reason;
}

}  // namespace
}  // namespace quadmap
