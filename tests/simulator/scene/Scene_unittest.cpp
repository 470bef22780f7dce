#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "../SceneFixture.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap::simulator
{
namespace
{
TEST(Scene, TruthIsTheTightCuboidOfTheSurface)
{
  std::mt19937 random(3);
  for (const auto& object : homeScene().objects)
  {
    const double infinity = std::numeric_limits<double>::infinity();
    Eigen::Vector3d low = Eigen::Vector3d::Constant(infinity), high = -low;
    for (const auto& part : object.parts)
      for (int i = 0; i < 20000; ++i)
      {
        const auto T_world_prim = object.T_world_obj + part.T_obj_prim;
        const Eigen::Vector3d p = transformed(T_world_prim, surfacePoint(part, random));
        const Eigen::Vector3d q = inverted(object.T_world_obj, p);
        low = low.cwiseMin(q);
        high = high.cwiseMax(q);
      }
    const Ellipsoid truth = object.truth();
    const Eigen::Vector3d center = transformed(object.T_world_obj, 0.5 * (low + high));
    // Extremes of 2e4 samples miss the corners and poles by up to 1 % of the size.
    const double tolerance = 0.01 * (high - low).maxCoeff();
    EXPECT_LT((truth.center() - center).norm(), tolerance) << object.name;
    EXPECT_LT((truth.semiAxes() - 0.5 * (high - low)).cwiseAbs().maxCoeff(), tolerance)
        << object.name;
    EXPECT_TRUE((truth.semiAxes().array() >= 0.5 * (high - low).array() - 1e-9).all());
  }
}

TEST(Scene, HomeIsAFurnishedRoom)
{
  const Scene scene = homeScene();
  const LabelTable labels = LabelTable::installed();
  std::set<std::string> kinds;
  std::set<Shape> shapes;
  unsigned labelled = 0, turned = 0, round = 0;
  for (const auto& object : scene.objects)
  {
    for (const auto& part : object.parts) shapes.insert(part.shape);
    if (object.label.empty()) continue;
    ++labelled;
    kinds.insert(object.label);
    EXPECT_TRUE(labels.properties(object.label).known) << object.label;
    EXPECT_EQ(object.label, labels.canonical(object.label)) << "COCO's spelling";
    if (!object.orientationDefined)
      ++round;
    else if (std::abs(std::sin(2 * object.T_world_obj.yaw())) > 0.1)
      ++turned;
    const Ellipsoid truth = object.truth();
    EXPECT_GE(truth.center().z() - truth.semiAxes().z(), -1e-9) << object.name << " sinks";
    const Eigen::Vector3d corner = truth.cuboidCorners().cwiseAbs().rowwise().maxCoeff();
    EXPECT_TRUE((corner.array().head<2>() <= 0.5 * scene.room.size.array().head<2>()).all())
        << object.name << " is in the wall";
  }
  EXPECT_GE(labelled, 13U);
  EXPECT_GE(kinds.size(), 9U);
  EXPECT_EQ(3U, shapes.size());
  EXPECT_GE(turned, 5U);
  EXPECT_GE(round, 4U);
}

TEST(Scene, ObjectsMayHaveTheirOwnPartsBesidesAModel)
{
  const Scene scene = sceneFromText(
      kRoomText +
      "[model ball]\npart1 = ellipsoid 0 0 0.1  0.2 0.2 0.2 grey\n"
      "[object a]\nlabel = none\nposition = 1 0 0\npart1 = box 0 0 0.5 1 1 1 screen 90 0 0\n"
      "[object b]\nlabel = sports ball\nmodel = ball\nposition = -1 0.5 0\nyaw_deg = 30\n"
      "orientation_defined = no\npart_x = cylinder 0 0 1 0.1 0.1 0.4 grey\n");
  ASSERT_EQ(2U, scene.objects.size());
  EXPECT_EQ("", scene.objects[0].label);
  EXPECT_TRUE(scene.objects[0].orientationDefined);
  EXPECT_EQ("screen", scene.materials[scene.objects[0].parts[0].material].name);
  EXPECT_NEAR(M_PI / 2, scene.objects[0].parts[0].T_obj_prim.yaw(), 1e-12);
  const SceneObject& b = scene.objects[1];
  EXPECT_EQ("b", b.name);
  EXPECT_EQ("sports ball", b.label);
  EXPECT_FALSE(b.orientationDefined);
  ASSERT_EQ(2U, b.parts.size());
  EXPECT_EQ(Shape::Ellipsoid, b.parts[0].shape);
  EXPECT_EQ(Shape::Cylinder, b.parts[1].shape);
  EXPECT_NEAR(0.6, b.truth().semiAxes().z(), 1e-12) << "0 to 1.2 m";
  EXPECT_FALSE(scene.materials[scene.objects[0].parts[0].material].depth);
}

TEST(Scene, ReadsTheOptionsOfEveryModule)
{
  const Scene scene = sceneFromText(
      kRoomText +
      "bob = 0.1\n[camera]\nwidth = 320\nfocal = 300\n[depth_noise]\nshadow = no\n"
      "axialBase = 0.5\n[odometry]\nscale = 0.2\n[detector]\njitter = 7\n");
  EXPECT_EQ(320, scene.options.camera.width);
  EXPECT_EQ(480, scene.options.camera.height) << "default";
  EXPECT_EQ(300, scene.options.camera.focal);
  EXPECT_EQ(5, scene.options.trajectory.frames);
  EXPECT_EQ(0.1, scene.options.trajectory.bob);
  EXPECT_FALSE(scene.options.depthNoise.shadow);
  EXPECT_EQ(0.5, scene.options.depthNoise.axialBase);
  EXPECT_EQ(0.2, scene.options.odometry.scale);
  EXPECT_EQ(7, scene.options.detector.jitter);
}

struct BadScene
{
  std::string find, replacement;      // in the room's text; empty `find`: appended
  std::vector<std::string> expected;  // parts of the message
};

class BadSceneFile : public ::testing::TestWithParam<BadScene>
{
};

TEST_P(BadSceneFile, IsRejectedWithFileSectionAndKey)
{
  std::string text = kRoomText;
  const BadScene& bad = GetParam();
  if (bad.find.empty())
    text += bad.replacement;
  else
    text.replace(text.find(bad.find), bad.find.size(), bad.replacement);
  const std::string message = errorOf([&] { sceneFromText(text); });
  EXPECT_NE(std::string::npos, message.find("scene.ini")) << message;
  EXPECT_EQ(std::string::npos, message.find('\n')) << "one line";
  for (const auto& part : bad.expected)
    EXPECT_NE(std::string::npos, message.find(part)) << part << " in: " << message;
}

const std::string kObject = "[object a]\nlabel = cup\nposition = 1 0 0\n";

INSTANTIATE_TEST_SUITE_P(
    Table,
    BadSceneFile,
    ::testing::Values(
        BadScene{
            "size = 6 6 2.6\n", "", {"[room]", "size", "missing"}
},
        BadScene{"size = 6 6 2.6", "size = 6 6", {"[room]", "size=6 6", "three"}},
        BadScene{"size = 6 6 2.6", "size = 6 six 2.6", {"[room]", "size", "six"}},
        BadScene{"size = 6 6 2.6", "size = 6 nan 2.6", {"[room]", "size", "nan"}},
        BadScene{"floor = grey", "floor = marble", {"[room]", "floor", "[material marble]"}},
        BadScene{"floor = grey", "flor = grey", {"[room]", "flor"}},
        BadScene{"128 128 128", "300 0 0", {"[material grey]", "color", "300"}},
        BadScene{"depth = no", "depth = maybe", {"[material screen]", "depth", "maybe"}},
        BadScene{"depth = no", "pattern = dots", {"[material screen]", "pattern", "dots"}},
        BadScene{"depth = no", "contrast = 2", {"[material screen]", "contrast", "2"}},
        BadScene{"frames = 5", "frames = 1", {"[trajectory]", "frames", "1"}},
        BadScene{"frames = 5", "frame = 5", {"[trajectory]", "\"frame\""}},
        BadScene{"waypoint4", ";waypoint4", {"[trajectory]", "waypoint4"}},
        BadScene{"waypoint4", "waypoint_d", {"[trajectory]", "waypoint_d"}},
        BadScene{"0 0.5 1.3  2 0 1.3", "0 0.5 1.3", {"[trajectory]", "waypoint4", "six"}},
        BadScene{"", "[object a]\nposition = 0 0 0\n", {"[object a]", "label", "missing"}},
        BadScene{"", "[object a]\nlabel = cup\n", {"[object a]", "position", "missing"}},
        BadScene{"", kObject, {"[object a]", "neither a model nor a part"}},
        BadScene{"", kObject + "model = x\n", {"[object a]", "model", "[model x]"}},
        BadScene{"", kObject + "yaw = 5\n", {"[object a]", "\"yaw\""}},
        BadScene{"", kObject + "yaw_deg = 5x\n", {"[object a]", "yaw_deg", "5x"}},
        BadScene{"", kObject + "part1 = box 0 0 0 1 1 1\n", {"[object a]", "part1", "expected"}},
        BadScene{"", kObject + "part1 = cone 0 0 0 1 1 1 grey\n", {"part1", "box, cylinder"}},
        BadScene{"", kObject + "part1 = box 0 0 0 1 0 1 grey\n", {"part1", "\"0\""}},
        BadScene{"", kObject + "part1 = box 0 0 0 1 1 1 gray\n", {"part1", "[material gray]"}},
        BadScene{"", "[model m]\n;\n", {"[model m]", "no part"}},
        BadScene{"", "[lamp]\nx = 1\n", {"[lamp]", "unknown section"}},
        BadScene{"", "[camera]\nwidth = 10\n", {"[camera]", "width", "10"}},
        BadScene{"", "[camera]\nzoom = 2\n", {"[camera]", "zoom"}},
        BadScene{"", "[depth_noise]\nminRange = 9\n", {"[depth_noise]", "minRange"}},
        BadScene{"", "[depth_noise]\nnoise = 1\n", {"[depth_noise]", "noise"}},
        BadScene{"", "[odometry]\nscale = 2\n", {"[odometry]", "scale"}},
        BadScene{"", "[odometry]\nx = 2\n", {"[odometry]", "\"x\""}},
        BadScene{"", "[detector]\nmissRate = 1.1\n", {"[detector]", "missRate"}},
        BadScene{"", "[detector]\nx = 2\n", {"[detector]", "\"x\""}},
        BadScene{"", "[detector]\noutput = faces\n", {"[detector]", "output=faces"}},
        BadScene{"frames = 5", "kind = fly", {"[trajectory]", "kind=fly"}},
        BadScene{"frames = 5", "kind = drive", {"[trajectory]", "waypoint1", "heading"}},
        BadScene{"", "[camera left]\nposition = 0 0\n", {"[camera left]", "position=0 0"}},
        BadScene{"", "nonsense\n", {"key = value"}}));

TEST(Scene, NamesAreLookedUpAndPathsAreTakenAsTheyAre)
{
  EXPECT_NE(std::string::npos, findScene("home").find("scenes/home.ini"));
  EXPECT_EQ("./home", findScene("./home"));
  EXPECT_EQ("mine.ini", findScene("mine.ini"));
  EXPECT_NE("", errorOf([] { findScene("no_such_scene"); }));
  EXPECT_NE(std::string::npos, errorOf([] { readScene("/no/such.ini"); }).find("/no/such.ini"));
}

}  // namespace
}  // namespace quadmap::simulator
