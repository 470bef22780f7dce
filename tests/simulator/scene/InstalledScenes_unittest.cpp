#include <gtest/gtest.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "../SceneFixture.h"
#include "quadmap/simulator/Simulator.h"

namespace quadmap::simulator
{
namespace
{
class InstalledScene : public ::testing::TestWithParam<const char*>
{
};

TEST_P(InstalledScene, StandsInItsRoomWithLabelsADetectorKnows)
{
  const Scene scene = readScene(findScene(GetParam()));
  const LabelTable labels = LabelTable::installed();
  for (const auto& object : scene.objects)
  {
    if (object.label.empty()) continue;
    EXPECT_TRUE(labels.properties(object.label).known) << object.name << ": " << object.label;
    EXPECT_EQ(object.label, labels.canonical(object.label)) << object.name;
    const Ellipsoid truth = object.truth();
    EXPECT_GE(truth.center().z() - truth.semiAxes().z(), -1e-3) << object.name << " sinks";
    const Eigen::Vector3d corner = truth.cuboidCorners().cwiseAbs().rowwise().maxCoeff();
    EXPECT_TRUE((corner.array().head<2>() <= 0.5 * scene.room.size.array().head<2>()).all())
        << object.name << " is in the wall";
  }
  EXPECT_NO_THROW(Simulator(scene, labels, 1)) << "the way is free";
}

INSTANTIATE_TEST_SUITE_P(
    All,
    InstalledScene,
    ::testing::Values(
        "home",
        "office",
        "robot-home",
        "robot-home-four",
        "cluttered-desk",
        "corridor",
        "lifelong",
        "approach",
        "dais",
        "two-storeys",
        "no-floor"));

std::size_t labelledIn(const Scene& scene)
{
  return static_cast<std::size_t>(std::count_if(
      scene.objects.begin(), scene.objects.end(),
      [](const SceneObject& o) { return !o.label.empty(); }));
}

/** Number of objects of each label. */
std::map<std::string, int> labelsIn(const std::string& scene)
{
  std::map<std::string, int> counts;
  for (const auto& object : readScene(findScene(scene)).objects) ++counts[object.label];
  return counts;
}

TEST(InstalledScenes, HaveTheFurnitureOfTheirKindOfRoom)
{
  using Counts = std::map<std::string, int>;
  const Counts home{
      {       "couch", 1},
      {       "chair", 2},
      {"dining table", 1},
      {          "tv", 1},
      {         "bed", 1},
      {"potted plant", 2},
      {        "vase", 1},
      {         "cup", 2}
  };
  const Counts office{
      {      "tv", 2},
      {"keyboard", 2},
      {    "book", 2},
      {    "desk", 2},
      { "cabinet", 1},
      {   "chair", 2}
  };
  for (const auto& [scene, fewest] : {
           std::pair{  "home",   home},
           {"office", office}
  })
    for (const auto& [label, count] : fewest)
      EXPECT_GE(labelsIn(scene)[label], count) << scene << ": " << label;
}

TEST(InstalledScenes, RobotsDriveOnTheFloorWithCamerasAtChestHeight)
{
  for (const auto* name : {"robot-home", "robot-home-four"})
  {
    const Simulator simulator(readScene(findScene(name)), LabelTable::installed(), 1);
    for (std::size_t i = 0; i < simulator.frameCount(); ++i)
    {
      const auto& pose = simulator.truePoses()[i];
      EXPECT_EQ(0, pose.z());
      EXPECT_NEAR(0, std::abs(pose.pitch()) + std::abs(pose.roll()), 1e-12);
      const double height = (pose + simulator.camera(i).T_robot_camera()).z();
      EXPECT_TRUE(height >= 0.5 && height <= 1.0) << name << ": " << height;
    }
  }
}

TEST(InstalledScenes, ApproachComesFromFourMetresToOne)
{
  Scene scene = readScene(findScene("approach"));
  EXPECT_EQ(Motion::Approach, scene.options.trajectory.kind);
  EXPECT_GE(labelledIn(scene), 4U);
  const Simulator simulator(scene, LabelTable::installed(), 1);
  const auto distance = [&](const mrpt::poses::CPose3D& pose)
  { return (transformed(pose, Eigen::Vector3d::Zero()) - scene.waypoints[0].target).norm(); };
  EXPECT_NEAR(4, distance(simulator.truePoses().front()), 0.1);
  EXPECT_NEAR(1, distance(simulator.truePoses().back()), 0.1);
}

/** Heights of the camera and of the lowest points of labelled things. */
struct Heights
{
  double lowestEye = 1e9, highestEye = -1e9;
  std::set<int> bottoms_cm;  // of things that stand on floors
};

Heights heightsIn(const std::string& name)
{
  const Scene scene = readScene(findScene(name));
  Heights out;
  for (const auto& waypoint : scene.waypoints)
  {
    out.lowestEye = std::min(out.lowestEye, waypoint.eye.z());
    out.highestEye = std::max(out.highestEye, waypoint.eye.z());
  }
  for (const auto& object : scene.objects)
    if (LabelTable::installed().properties(object.label).support == UsualSupport::Floor &&
        !object.label.empty())
      out.bottoms_cm.insert(static_cast<int>(std::lround(100 * object.T_world_obj.z())));
  return out;
}

TEST(InstalledScenes, HaveFloorsOfSeveralHeights)
{
  const Heights dais = heightsIn("dais"), storeys = heightsIn("two-storeys");
  EXPECT_EQ(dais.bottoms_cm, (std::set<int>{0, 25}));
  EXPECT_NEAR(dais.highestEye - dais.lowestEye, 0.25, 0.05) << "the camera steps on it";
  EXPECT_EQ(storeys.bottoms_cm, (std::set<int>{0, 260}));
  EXPECT_NEAR(storeys.highestEye - storeys.lowestEye, 2.6, 0.1) << "the camera goes up";
}

/** Largest share of an image that the floor has, over every fifth image. */
double mostFloorIn(const std::string& name)
{
  const Simulator simulator(readScene(findScene(name)), LabelTable::installed(), 1);
  const PinholeCamera camera = smallCamera();
  const RayCaster caster(simulator.scene(), camera);
  double most = 0;
  for (std::size_t i = 0; i < simulator.frameCount(); i += 5)
  {
    const auto& T_world_camera = simulator.truePoses()[i];
    const RenderedFrame image = caster.render(T_world_camera);
    double floor = 0;
    for (std::size_t pixel = 0; pixel < image.depth.size(); ++pixel)
    {
      if (image.object[pixel] != RenderedFrame::kRoom) continue;
      const double u = static_cast<double>(pixel % camera.width);
      const double v = static_cast<double>(pixel / camera.width);
      const Eigen::Vector3d optical = image.depth[pixel] * camera.ray(u, v);
      const Eigen::Vector3d point(optical.z(), -optical.x(), -optical.y());
      if (transformed(T_world_camera, point).z() < 0.01) ++floor;
    }
    most = std::max(most, floor / static_cast<double>(image.depth.size()));
  }
  return most;
}

TEST(InstalledScenes, NoFloorShowsHardlyAnyFloor)
{
  EXPECT_LT(mostFloorIn("no-floor"), 0.01);
  EXPECT_GT(mostFloorIn("home"), 0.2);
}

TEST(InstalledScenes, AreWhatTheirNamesSay)
{
  EXPECT_EQ(10U, labelledIn(readScene(findScene("robot-home"))));
  EXPECT_EQ(2U, readScene(findScene("robot-home")).options.cameras().size());
  EXPECT_EQ(4U, readScene(findScene("robot-home-four")).options.cameras().size());
  EXPECT_EQ(31U, labelledIn(readScene(findScene("cluttered-desk")))) << "thirty and the desk";
  EXPECT_GE(readScene(findScene("corridor")).room.size.x(), 20);
  EXPECT_EQ(3, readScene(findScene("lifelong")).options.trajectory.rounds);
}

const std::string kMovingCup =
    "[object cup]\nlabel = cup\nposition = 1.5 0 1.3\nfrom = 10\nto = 40\n"
    "move1 = 20  1.5 0.4 1.3  30\nmove2 = 30  1.5 -0.4 1.3  0\n"
    "part1 = box 0 0 0 0.2 0.2 0.2 grey\n";

TEST(SceneOverTime, ObjectsComeMoveAndGo)
{
  const Scene scene = sceneFromText(kRoomText + kMovingCup);
  ASSERT_EQ(3U, scene.objects.size()) << "one for each place";
  const PinholeCamera camera = smallCamera();
  const RayCaster caster(scene, camera);
  for (const auto& [time, column] : {
           std::pair{ 5.0,  -1},
           {10.0,  80},
           {19.9,  80},
           {20.0,  45},
           {30.0, 115},
           {39.9, 115},
           {40.0,  -1}
  })
  {
    const RenderedFrame frame = caster.render(lookingAhead(), time);
    const auto visible = visibleObjects(scene, frame, DetectorOptions());
    ASSERT_EQ(column < 0 ? 0U : 1U, visible.size()) << time;
    if (column < 0) continue;
    // 0.4 m at 1.4 m, f = 131 px: 37 px to the side; the box shows its sides too.
    EXPECT_NEAR(column, visible[0].box.centerX(), 4) << time;
  }
}

TEST(SceneOverTime, MovesAreInTheOrderOfTheirNumbers)
{
  std::string text =
      kRoomText + "[object cup]\nlabel = cup\nposition = 0 0 0\npart1 = box 0 0 0 1 1 1 grey\n";
  for (int i = 1; i <= 11; ++i) text += mrpt::format("move%d = %d  %g 0 0  0\n", i, i, 0.1 * i);
  const Scene scene = sceneFromText(text);
  ASSERT_EQ(12U, scene.objects.size());
  for (std::size_t i = 1; i < 12; ++i)
  {
    EXPECT_EQ(double(i), scene.objects[i].from);
    EXPECT_NEAR(0.1 * double(i), scene.objects[i].T_world_obj.x(), 1e-9);
  }
  const auto error = [&](const std::string& key)
  { return errorOf([&] { sceneFromText(text + key + " = 20  0 0 0  0\n"); }); };
  EXPECT_NE(std::string::npos, error("move_on").find("moveNUMBER"));
  EXPECT_NE(std::string::npos, error("move011").find("another one"));
}

TEST(SceneOverTime, TruthSaysWhenWhatStoodWhere)
{
  const TemporaryFolder folder;
  Scene scene = sceneFromText(kRoomText + kMovingCup);
  scene.options.resize(64, 64);
  scene.options.trajectory.frames = 50;
  scene.options.trajectory.duration = 50;
  simulateToFiles(Simulator(scene, LabelTable::installed(), 1), folder.path("a.rawlog"));
  const auto truth = readObjectsJson(folder.path("a.objects.gt.json"));
  ASSERT_EQ(3U, truth.size());
  const double start = scene.options.trajectory.startTime;
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(start + 10.0 * double(i + 1), truth[i].from.value_or(0));
    EXPECT_EQ(start + 10.0 * double(i + 2), truth[i].to.value_or(0));
    EXPECT_LE(truth[i].framesVisible.value_or(99), 10U) << "a frame a second";
  }
  EXPECT_NEAR(0.4, truth[1].object.center().y(), 1e-9);
  const auto lasting =
      objectsToJson({readObjectsJson(QUADMAP_SOURCE_DIR "/rawlogs/home.objects.gt.json")[0]});
  EXPECT_EQ(std::string::npos, lasting.find("\"from\"")) << "what always stands there";
}

TEST(SceneOverTime, RejectsTimesThatMakeNoSense)
{
  for (const auto& [find, replacement] : {
           std::pair{   "to = 40",     "to = 5"},
           {"move2 = 30", "move2 = 15"},
           {"move2 = 30", "move2 = 45"},
           {   "1.3  30",        "1.3"}
  })
  {
    std::string text = kRoomText + kMovingCup;
    text.replace(text.find(find), std::string(find).size(), replacement);
    EXPECT_NE(std::string::npos, errorOf([&] { sceneFromText(text); }).find("[object cup]"));
  }
  EXPECT_NE(
      std::string::npos,
      errorOf([] { sceneFromText(kRoomText + "kind = approach\nrounds = 2\n"); }).find("rounds"));
}

TEST(SceneOverTime, RoundsRepeatTheWay)
{
  Scene scene = sceneFromText(kRoomText + "bob = 0\nsway_deg = 0\nrounds = 3\n");
  scene.options.trajectory.frames = 30;
  const auto truth = Simulator(scene, LabelTable::installed(), 1).truePoses();
  for (std::size_t i = 0; i < 20; ++i) EXPECT_LT((truth[i] - truth[i + 10]).norm(), 1e-9);
  EXPECT_GT((truth[0] - truth[5]).norm(), 0.2);
}

}  // namespace
}  // namespace quadmap::simulator
