#include "support/SupportChoice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../../obs/InstalledLabels.h"
#include "../../surfaces/SyntheticFrame.h"

namespace quadmap
{
namespace
{
/** A support in the words of the tests. */
struct Chosen
{
  std::optional<double> height;  // of the supporting plane in the world [m]
  bool onWall = false;
};

/** Of the boxes of a frame, in the order of the detections. */
std::vector<Chosen> chosenIn(
    const SyntheticFrame& frame,
    const std::vector<DetectedObject>& detections,
    const std::vector<SurfacePatch>& known_world = {})
{
  const PerceptionOptions options;
  const DepthCloud cloud(frame.scan(), options);
  const mrpt::poses::CPose3D T_world_optical = frame.T_world_sensor + T_sensor_optical();
  std::vector<SurfacePatch> known;
  for (const auto& patch : known_world) known.push_back(transformed(patch, -T_world_optical));
  const Eigen::Vector3d up = T_world_optical.getRotationMatrix().asEigen().row(2);
  const SupportedScene scene = chooseSupports(
      cloud, classifyPlanes(cloud, segmentPlanes(cloud, options), up, known, options), detections,
      labels(), options);
  std::vector<Chosen> out;
  for (const auto& support : scene.supports)
  {
    Chosen chosen{{}, support.wall.has_value()};
    if (support.plane)
    {
      // Level planes: their height is that of any of their points.
      const Plane plane = scene.planes.plane(*support.plane).plane.transformed(T_world_optical);
      chosen.height = -plane.d / plane.n.z();
    }
    out.push_back(chosen);
  }
  return out;
}

Chosen chosenFor(
    const SyntheticFrame& frame,
    std::size_t box,
    const std::string& label,
    const std::vector<SurfacePatch>& known_world = {})
{
  return chosenIn(frame, {frame.detect(box, label)}, known_world).front();
}

SyntheticFrame frameFrom(double y, double height, double pitchDown, double yaw = 0)
{
  SyntheticFrame frame;
  frame.T_world_sensor = mrpt::poses::CPose3D(0, y, height, yaw, pitchDown, 0);
  frame.noise = 0.0015;
  frame.camera.setIntrinsicParamsFromValues(262.5, 262.5, 159.5, 119.5);
  frame.camera.ncols = 320;
  frame.camera.nrows = 240;
  return frame;
}

/** A table of one top and four legs; the first box added is the top. */
void addTable(SyntheticFrame& frame, double x, double y, double height, double depth, double width)
{
  constexpr double kTop = 0.04, kLeg = 0.05;
  frame.add(x, y, height - kTop, 0, {depth, width, kTop});
  for (const double sx : {-0.5, 0.5})
    for (const double sy : {-0.5, 0.5})
      frame.add(
          x + sx * (depth - kLeg), y + sy * (width - kLeg), 0, 0, {kLeg, kLeg, height - kTop});
}

constexpr double kTolerance = 0.03;  // what the tests call the right height [m]

#define EXPECT_SUPPORT(chosen, z, what)                                \
  do                                                                   \
  {                                                                    \
    EXPECT_TRUE((chosen).height) << (what);                            \
    EXPECT_NEAR((chosen).height.value_or(z), z, kTolerance) << (what); \
  } while (false)

struct Viewpoint
{
  double y, height, pitch;
  std::string text() const
  {
    return "y " + std::to_string(y) + ", height " + std::to_string(height);
  }
};

const Viewpoint kViewpoints[] = {
    { 0.0, 1.3, 0.35},
    { 0.5, 1.3, 0.35},
    {-0.4, 1.5, 0.45},
    { 0.2, 1.1, 0.25}
};

TEST(SupportChoice, LeavesThingsBehindATableOnTheFloor)
{
  // The first failure case of the paper: the plane of the table goes on under the object.
  for (const auto& view : kViewpoints)
    for (const char* label : {"chair", "potted plant", "suitcase"})
    {
      SyntheticFrame frame = frameFrom(view.y, view.height, view.pitch);
      frame.add(1.6, 0.0, 0.0, 0.0, {0.7, 1.6, 0.72});   // hides everything under its top
      frame.add(2.35, 0.1, 0.0, 0.0, {0.4, 0.45, 1.0});  // 20 cm behind it
      frame.add(3.6, -1.5, 0.0, 0.0, {0.3, 0.3, 0.3});
      const SurfacePatch floor = {
          SurfaceKind::Floor, {Eigen::Vector3d::UnitZ(), 0.0},
           {     }
      };
      const auto chosen = chosenFor(frame, 1, label, {floor});
      // Its foot is out of sight: what stands anywhere may have a support nobody saw.
      const bool mayBeAnywhere =
          labels().properties(label).support != UsualSupport::Floor && !chosen.height;
      EXPECT_TRUE(mayBeAnywhere || (chosen.height && std::abs(*chosen.height) < kTolerance))
          << label << " from " << view.text() << " at " << chosen.height.value_or(NAN);
    }
}

TEST(SupportChoice, LeavesThingsSeenUnderATableOnTheFloor)
{
  for (const auto& view : kViewpoints)
    for (const char* label : {"chair", "potted plant", "backpack"})
    {
      SyntheticFrame frame = frameFrom(view.y, view.height, view.pitch);
      addTable(frame, 1.9, 0.0, 0.74, 0.8, 1.4);
      const std::size_t thing = frame.boxes.size();
      frame.add(2.7, 0.1, 0.0, 0.2, {0.35, 0.4, 0.95});
      EXPECT_SUPPORT(chosenFor(frame, thing, label), 0.0, label + (" from " + view.text()));
    }
}

TEST(SupportChoice, PutsAChairOnThePlatformItStandsOn)
{
  const SurfacePatch floor = {
      SurfaceKind::Floor, {Eigen::Vector3d::UnitZ(), 0.0},
       {     },
       false
  };
  for (const auto& view : kViewpoints)
    for (const bool isFurniture : {false, true})
    {
      constexpr double kHeight = 0.25;
      SyntheticFrame frame = frameFrom(view.y, view.height, view.pitch);
      frame.add(2.6, 0.0, 0.0, 0.0, {2.0, 2.4, kHeight});
      frame.add(2.6, 0.1, kHeight, 0.3, {0.45, 0.45, 0.9});
      SurfacePatch platform = {
          SurfaceKind::Horizontal, {Eigen::Vector3d::UnitZ(), -kHeight},
           {          },
           isFurniture
      };
      for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 48; ++j)
          platform.samples.emplace_back(1.6f + 0.05f * float(i), -1.2f + 0.05f * float(j), 0.25f);
      const auto chosen = chosenFor(frame, 1, "chair", {floor, platform});
      EXPECT_SUPPORT(chosen, isFurniture ? 0.0 : kHeight, view.text());
    }
}

TEST(SupportChoice, PutsNothingThatIsBelowTheFloorOnIt)
{
  SyntheticFrame frame = frameFrom(0, 1.5, 0.5);
  frame.hasFloor = false;
  frame.add(2.4, 0.1, -1.6, 0.3, {0.45, 0.45, 0.9});  // down a flight of stairs
  const SurfacePatch upstairs = {
      SurfaceKind::Floor, {Eigen::Vector3d::UnitZ(), 0.0},
       {     },
       false
  };
  EXPECT_FALSE(chosenFor(frame, 0, "chair", {upstairs}).height);
}

TEST(SupportChoice, KeepsAChairPushedUnderATableOnTheFloor)
{
  for (const auto& view : kViewpoints)
  {
    SyntheticFrame frame = frameFrom(view.y, view.height, view.pitch);
    addTable(frame, 1.9, 0.0, 0.74, 0.8, 1.4);
    const std::size_t back = frame.boxes.size();
    frame.add(2.34, 0.1, 0.0, 0.0, {0.04, 0.42, 0.92});  // 2 cm behind the edge
    frame.add(2.15, 0.1, 0.42, 0.0, {0.4, 0.42, 0.04});  // the seat is under the table
    EXPECT_SUPPORT(chosenFor(frame, back, "chair"), 0.0, view.text());
  }
}

TEST(SupportChoice, KeepsAChairBehindAnEdgeSeenFromAboveOnTheFloor)
{
  for (const double height : {1.5, 1.7})
    for (const double top : {0.55, 0.74})  // of a bed, or a table
    {
      SyntheticFrame frame = frameFrom(0, height, 0.6);
      frame.add(1.2, 0.0, 0.0, 0.0, {0.8, 1.4, top});
      const std::size_t back = frame.boxes.size();
      frame.add(1.64, 0.1, 0.0, 0.0, {0.04, 0.42, 0.92});
      const std::string what = std::to_string(top) + " m, from " + std::to_string(height) + " m";
      EXPECT_SUPPORT(chosenFor(frame, back, "chair"), 0.0, what);
    }
}

TEST(SupportChoice, PutsThingsOnTheTableTheyStandOn)
{
  struct Thing
  {
    const char* label;
    double x, y;
    Eigen::Vector3d size;
  };
  const Thing things[] = {
      {         "cup", 1.75,  0.10, {0.09, 0.09, 0.10}},
      {        "vase", 2.15, -0.30, {0.15, 0.15, 0.28}}, // near the far edge
      {     "monitor", 2.10,  0.20, {0.10, 0.55, 0.45}},
      {"potted plant", 2.00, -0.45, {0.25, 0.25, 0.35}},
      {      "laptop", 1.80,  0.25, {0.25, 0.35, 0.20}},
      {        "book", 1.80, -0.20, {0.22, 0.30, 0.05}},
      {    "suitcase", 1.90,  0.00, {0.35, 0.45, 0.30}}  // usually on the floor
  };
  for (const auto& view : kViewpoints)
    for (const auto& thing : things)
    {
      SyntheticFrame frame = frameFrom(view.y, view.height, view.pitch);
      addTable(frame, 1.9, 0.0, 0.74, 0.8, 1.4);
      const std::size_t index = frame.boxes.size();
      frame.add(thing.x, thing.y, 0.74, 0.3, thing.size);
      EXPECT_SUPPORT(
          chosenFor(frame, index, thing.label), 0.74, thing.label + (" from " + view.text()));
    }
}

TEST(SupportChoice, PutsACupOnTheBookItStandsOn)
{
  for (const auto& view : kViewpoints)
  {
    if (view.height < 1.2) continue;  // hardly any of the cover shows
    SyntheticFrame frame = frameFrom(view.y, view.height, view.pitch);
    addTable(frame, 1.6, 0.0, 0.74, 0.8, 1.4);
    const std::size_t book = frame.boxes.size();
    frame.add(1.5, 0.0, 0.74, 0.2, {0.24, 0.32, 0.08});
    frame.add(1.5, 0.0, 0.82, 0.0, {0.09, 0.09, 0.10});
    const auto chosen =
        chosenIn(frame, {frame.detect(book, "book"), frame.detect(book + 1, "cup")});
    EXPECT_SUPPORT(chosen[0], 0.74, "book from " + view.text());
    EXPECT_SUPPORT(chosen[1], 0.82, "cup from " + view.text());
  }
}

/** A table top at a height as other frames knew it, `x` and `y` its middle in the world. */
SurfacePatch knownTop(double x, double y, double height, double depth, double width)
{
  constexpr double kCell = 0.05;  // [m]
  SurfacePatch out = {
      SurfaceKind::Horizontal, {Eigen::Vector3d::UnitZ(), -height},
       {         }
  };
  for (double dx = kCell / 2 - depth / 2; dx < depth / 2; dx += kCell)
    for (double dy = kCell / 2 - width / 2; dy < width / 2; dy += kCell)
      out.samples.push_back(Eigen::Vector3d(x + dx, y + dy, height).cast<float>());
  return out;
}

TEST(SupportChoice, PutsWhatStandsBehindABookOnTheTable)
{
  // The book hides its foot: the cover might go on under it, but not outside the book's own box.
  for (const auto& view : kViewpoints)
    for (const double gap : {0.06, 0.10, 0.16})
    {
      SyntheticFrame frame = frameFrom(view.y, view.height, view.pitch);
      addTable(frame, 1.6, 0.0, 0.74, 0.8, 1.4);
      const std::size_t book = frame.boxes.size();
      frame.add(1.45, 0.0, 0.74, 0.0, {0.24, 0.32, 0.08});
      frame.add(1.57 + gap + 0.075, 0.0, 0.74, 0.0, {0.15, 0.15, 0.28});
      const auto chosen =
          chosenIn(frame, {frame.detect(book, "book"), frame.detect(book + 1, "vase")});
      EXPECT_SUPPORT(chosen[1], 0.74, std::to_string(gap) + " behind, from " + view.text());
    }
}

TEST(SupportChoice, TakesTheHeightOfAClutteredTableFromTheFrame)
{
  // Between the clutter no part of the table is large enough for a plane; other frames knew it, but
  // their poses erred.
  for (const double poseError : {-0.02, 0.02})
  {
    SyntheticFrame frame = frameFrom(0.0, 1.4, 0.6);
    frame.add(1.4, 0.0, 0.70, 0.0, {0.8, 1.4, 0.04});
    for (int i = 0; i < 6; ++i)
      for (int j = -5; j <= 5; ++j)
        if (i != 3 || j != 0) frame.add(1.05 + 0.13 * i, 0.13 * j, 0.74, 0.0, {0.03, 0.03, 0.1});
    const std::size_t apple = frame.boxes.size();
    frame.add(1.44, 0.0, 0.74, 0.0, {0.08, 0.08, 0.08});
    const auto known = knownTop(1.4, 0.0, 0.74 + poseError, 0.8, 1.4);
    const auto chosen = chosenFor(frame, apple, "apple", {known});
    ASSERT_TRUE(chosen.height) << "pose error " << poseError;
    EXPECT_NEAR(*chosen.height, 0.74, 0.005) << "pose error " << poseError;
  }
}

TEST(SupportChoice, PutsABookOnABook)
{
  for (const auto& view : kViewpoints)
  {
    if (view.height < 1.2) continue;  // hardly any of the cover shows
    SyntheticFrame frame = frameFrom(view.y, view.height, view.pitch);
    addTable(frame, 1.6, 0.0, 0.74, 0.8, 1.4);
    const std::size_t lower = frame.boxes.size();
    frame.add(1.5, 0.0, 0.74, 0.2, {0.30, 0.40, 0.08});
    frame.add(1.53, 0.03, 0.82, 0.5, {0.18, 0.24, 0.06});
    const auto chosen =
        chosenIn(frame, {frame.detect(lower, "book"), frame.detect(lower + 1, "book")});
    EXPECT_SUPPORT(chosen[0], 0.74, "lower from " + view.text());
    EXPECT_SUPPORT(chosen[1], 0.82, "upper from " + view.text());
  }
}

TEST(SupportChoice, HangsATvOnTheWall)
{
  for (const double yaw : {-0.2, 0.0, 0.25})
  {
    SyntheticFrame frame = frameFrom(-2.0 * std::sin(yaw), 1.3, 0.05, yaw);
    frame.add(3.1, 0.0, 0.0, 0.0, {0.1, 6.0, 2.6});  // the wall
    frame.add(3.01, 0.1, 1.0, 0.0, {0.08, 1.0, 0.6});
    const auto chosen = chosenFor(frame, 1, "tv");
    EXPECT_TRUE(chosen.onWall) << "yaw " << yaw;
    EXPECT_FALSE(chosen.height) << "yaw " << yaw;
  }
}

TEST(SupportChoice, TellsACupboardOnTheWallFromTheCabinetBelow)
{
  for (const double yaw : {-0.2, 0.0, 0.25})
    for (const char* label : {"cabinet", "bookshelf"})
    {
      SyntheticFrame frame = frameFrom(-2.0 * std::sin(yaw), 1.3, 0.1, yaw);
      frame.add(3.1, 0.0, 0.0, 0.0, {0.1, 6.0, 2.6});  // the wall
      frame.add(2.75, 0.0, 0.0, 0.0, {0.6, 1.2, 0.9});
      frame.add(2.87, 0.0, 1.4, 0.0, {0.35, 0.9, 0.6});
      const std::string what = std::string(label) + ", yaw " + std::to_string(yaw);
      const auto chosen = chosenIn(frame, {frame.detect(1, label), frame.detect(2, label)});
      EXPECT_SUPPORT(chosen[0], 0.0, what);
      EXPECT_FALSE(chosen[1].height) << what;
    }
}

TEST(SupportChoice, PutsATvInFrontOfAWallOnItsStand)
{
  for (const double yaw : {-0.2, 0.0, 0.25})
  {
    SyntheticFrame frame = frameFrom(-2.0 * std::sin(yaw), 1.3, 0.2, yaw);
    frame.add(3.1, 0.0, 0.0, 0.0, {0.1, 6.0, 2.6});
    frame.add(2.8, 0.0, 0.0, 0.0, {0.45, 1.6, 0.5});
    frame.add(2.85, 0.1, 0.5, 0.0, {0.08, 1.0, 0.6});
    const auto chosen = chosenFor(frame, 2, "tv");
    EXPECT_FALSE(chosen.onWall) << "yaw " << yaw;
    EXPECT_SUPPORT(chosen, 0.5, "yaw " + std::to_string(yaw));
  }
}

TEST(SupportChoice, ClaimsNoSupportWhenTheSurfaceIsAboveTheEye)
{
  SyntheticFrame frame = frameFrom(0, 1.3, 0.05);
  frame.add(2.5, 0.0, 0.0, 0.0, {0.4, 1.0, 1.6});  // a cupboard; its top is out of sight
  frame.add(2.4, 0.1, 1.6, 0.0, {0.15, 0.15, 0.28});
  EXPECT_FALSE(chosenFor(frame, 1, "vase").height);
}

TEST(SupportChoice, UsesATableTopThatOnlyOtherFramesShowed)
{
  SyntheticFrame frame = frameFrom(0, 0.80, 0.0);  // nearly level with the top
  addTable(frame, 1.9, 0.0, 0.78, 0.8, 1.4);
  const std::size_t cup = frame.boxes.size();
  frame.add(1.7, 0.1, 0.78, 0.0, {0.09, 0.09, 0.10});
  SurfacePatch top = {
      SurfaceKind::Horizontal, {Eigen::Vector3d::UnitZ(), -0.78},
       {       }
  };
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 14; ++j)
      top.samples.emplace_back(1.55f + 0.1f * float(i), -0.65f + 0.1f * float(j), 0.78f);
  EXPECT_SUPPORT(chosenFor(frame, cup, "cup", {top}), 0.78, "known from other frames");
}

TEST(SupportChoice, DoesNotBelieveATableTopItLooksThrough)
{
  SyntheticFrame frame = frameFrom(0, 1.3, 0.45);
  frame.add(1.9, 0.0, 0.0, 0.2, {0.35, 0.35, 0.9});
  SurfacePatch gone = {
      SurfaceKind::Horizontal, {Eigen::Vector3d::UnitZ(), -0.5},
       {      }
  };
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 14; ++j)
      gone.samples.emplace_back(1.55f + 0.1f * float(i), -0.65f + 0.1f * float(j), 0.5f);
  EXPECT_SUPPORT(chosenFor(frame, 0, "potted plant", {gone}), 0.0, "the table was moved away");
}

TEST(SupportChoice, TellsATableFromWhatItCarries)
{
  SyntheticFrame frame = frameFrom(0, 1.4, 0.45);
  addTable(frame, 1.9, 0.0, 0.74, 0.8, 1.4);
  const std::size_t cup = frame.boxes.size();
  frame.add(1.75, 0.2, 0.74, 0.0, {0.09, 0.09, 0.10});
  frame.add(1.95, -0.3, 0.74, 0.0, {0.15, 0.15, 0.28});
  frame.add(2.9, 0.0, 0.0, 0.0, {0.45, 0.45, 0.9});
  DetectedObject table = frame.detect(0, "dining table");
  for (std::size_t leg = 1; leg < 5; ++leg)
    table.box.y2 = std::max(table.box.y2, frame.detect(leg, "").box.y2);
  const auto chosen = chosenIn(
      frame, {table, frame.detect(cup, "cup"), frame.detect(cup + 1, "vase"),
              frame.detect(cup + 2, "chair")});
  EXPECT_SUPPORT(chosen[0], 0.0, "the table");
  EXPECT_SUPPORT(chosen[3], 0.0, "the chair behind it");
  EXPECT_SUPPORT(chosen[1], 0.74, "the cup on it");
  EXPECT_SUPPORT(chosen[2], 0.74, "the vase on it");
}

TEST(SupportChoice, PutsTheBackOfAChairOnNoTable)
{
  // The floor is out of sight, and the back rises a little above the table, right behind its edge.
  for (const auto& view : kViewpoints)
  {
    SyntheticFrame frame = frameFrom(view.y, view.height, view.pitch);
    frame.hasFloor = false;
    frame.add(1.9, 0.0, 0.0, 0.0, {0.8, 1.6, 0.74});
    const std::size_t back = frame.boxes.size();
    frame.add(2.31, 0.1, 0.5, 0.0, {0.04, 0.42, 0.42});
    EXPECT_FALSE(chosenFor(frame, back, "chair").height) << view.text();
  }
}

TEST(SupportChoice, GivesTheSameAnswerTwice)
{
  SyntheticFrame frame = frameFrom(0.2, 1.3, 0.4);
  addTable(frame, 1.9, 0.0, 0.74, 0.8, 1.4);
  const std::size_t cup = frame.boxes.size();
  frame.add(1.75, 0.2, 0.74, 0.0, {0.09, 0.09, 0.10});
  const auto a = chosenFor(frame, cup, "cup"), b = chosenFor(frame, cup, "cup");
  ASSERT_TRUE(a.height && b.height);
  EXPECT_EQ(*a.height, *b.height);
}

}  // namespace
}  // namespace quadmap
