#include "quadmap/simulator/Simulator.h"

#include <gtest/gtest.h>

#include "SceneFixture.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/sensors/RawlogSource.h"

namespace quadmap::simulator
{
namespace
{
const char* const kExtensions[] = {
    ".rawlog", ".objects.rawlog", ".objects.gt.json", ".groundtruth.tum"};

/** The home with small images. */
Scene smallHome()
{
  Scene scene = homeScene();
  scene.options.camera.resize(160, 120);
  scene.options.trajectory.frames = 12;
  return scene;
}

SimulationSummary simulate(Scene scene, std::uint64_t seed, const std::string& rawlog)
{
  return simulateToFiles(Simulator(std::move(scene), LabelTable::installed(), seed), rawlog);
}

TEST(Simulator, SameSeedGivesTheSameBytes)
{
  const TemporaryFolder folder;
  simulate(smallHome(), 3, folder.path("a.rawlog"));
  simulate(smallHome(), 3, folder.path("b.rawlog"));
  simulate(smallHome(), 4, folder.path("c.rawlog"));
  for (const char* extension : kExtensions)
  {
    const std::string a = readFile(folder.path(std::string("a") + extension));
    EXPECT_GT(a.size(), 200U);
    EXPECT_TRUE(a == readFile(folder.path(std::string("b") + extension))) << extension;
  }
  for (const char* extension : {".rawlog", ".objects.rawlog"})
    EXPECT_FALSE(
        readFile(folder.path(std::string("a") + extension)) ==
        readFile(folder.path(std::string("c") + extension)))
        << "another seed, another recording";
  EXPECT_EQ(readFile(folder.path("a.groundtruth.tum")), readFile(folder.path("c.groundtruth.tum")))
      << "of the same walk";
  EXPECT_EQ(12U, folder.fileCount()) << "nothing else is left";
}

TEST(Simulator, FramesDoNotDependOnTheOrderTheyAreMadeIn)
{
  const Simulator simulator(smallHome(), LabelTable::installed(), 5);
  const SimulatedFrame late = simulator.frame(7);
  simulator.frame(2);
  const SimulatedFrame again = simulator.frame(7);
  EXPECT_TRUE(late.scan->rangeImage == again.scan->rangeImage);
  ASSERT_EQ(late.objects->objects.size(), again.objects->objects.size());
  for (std::size_t i = 0; i < late.objects->objects.size(); ++i)
    EXPECT_EQ(late.objects->objects[i].box.x1, again.objects->objects[i].box.x1);
}

TEST(Simulator, SaysWhichObjectEachBoxShows)
{
  Scene scene = smallHome();
  scene.options.scaleNoise(0);
  const Simulator simulator(scene, LabelTable::installed(), 5);
  for (const std::size_t index : {0U, 5U, 9U})
  {
    const SimulatedFrame frame = simulator.frame(index);
    ASSERT_EQ(frame.objects->objects.size(), frame.truthOfBox.size());
    ASSERT_EQ(frame.visible.size(), frame.truthOfBox.size()) << "without noise all are found";
    for (std::size_t i = 0; i < frame.truthOfBox.size(); ++i)
    {
      EXPECT_EQ(frame.visible[i].object, frame.truthOfBox[i].value_or(999));
      EXPECT_EQ(scene.objects[frame.visible[i].object].label, frame.objects->objects[i].label);
      EXPECT_EQ(frame.visible[i].box.x2, frame.objects->objects[i].box.x2);
    }
  }
}

TEST(Simulator, RawlogIsReadBackComplete)
{
  const TemporaryFolder folder;
  const auto summary = simulate(smallHome(), 1, folder.path("a.rawlog"));
  const Trajectory truth = readTumTrajectory(folder.path("a.groundtruth.tum"));
  ASSERT_EQ(12U, truth.size());
  EXPECT_EQ(12U, summary.frames);
  RawlogSource source(folder.path("a.rawlog"), RawlogSourceOptions());
  std::size_t boxes = 0, frames = 0;
  for (; const auto frame = source.next(); ++frames)
  {
    EXPECT_EQ("camera", frame->scan->sensorLabel);
    EXPECT_TRUE(frame->scan->hasIntensityImage);
    EXPECT_EQ(160U, frame->scan->cameraParams.ncols);
    EXPECT_NEAR(525 / 4.0, frame->scan->cameraParams.fx(), 1e-9);
    ASSERT_TRUE(frame->objects);
    boxes += frame->objects->objects.size();
    ASSERT_TRUE(frame->T_odom_robot && frame->T_world_robot);
    EXPECT_NEAR(truth[frames].time, frame->time(), 1e-6);
    EXPECT_LT((truth[frames].pose - *frame->T_world_robot).norm(), 1e-6);
    EXPECT_LT((truth[frames].pose - *frame->T_odom_robot).norm(), 0.5) << "drift";
    EXPECT_EQ(frames > 0, (truth[frames].pose - *frame->T_odom_robot).norm() > 1e-5);
  }
  EXPECT_EQ(12U, frames);
  EXPECT_EQ(summary.boxes, boxes);
  EXPECT_TRUE(source.problems().empty());
}

TEST(Simulator, TruthCountsTheFramesInWhichAnObjectCanBeSeen)
{
  const TemporaryFolder folder;
  const Simulator simulator(smallHome(), LabelTable::installed(), 1);
  const auto summary = simulateToFiles(simulator, folder.path("a.rawlog"));
  const auto truth = readObjectsJson(folder.path("a.objects.gt.json"));
  std::vector<unsigned> expected(simulator.scene().objects.size(), 0);
  for (std::size_t i = 0; i < simulator.frameCount(); ++i)
    for (const auto& seen : simulator.frame(i).visible) ++expected[seen.object];
  std::size_t next = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const SceneObject& object = simulator.scene().objects[i];
    if (object.label.empty()) continue;
    ASSERT_LT(next, truth.size());
    EXPECT_EQ(std::to_string(next + 1), truth[next].id);
    EXPECT_EQ(object.label, truth[next].label);
    EXPECT_EQ(object.orientationDefined, truth[next].orientationDefined);
    EXPECT_EQ(expected[i], truth[next].framesVisible.value_or(999));
    EXPECT_LT((object.truth().center() - truth[next].object.center()).norm(), 1e-6);
    EXPECT_LT((object.truth().semiAxes() - truth[next].object.semiAxes()).norm(), 1e-6);
    ++next;
  }
  EXPECT_EQ(truth.size(), next);
  EXPECT_EQ(truth.size(), summary.truth.size());
}

TEST(Simulator, PerfectSensorsSeeThePointsOfTheSurfaces)
{
  Scene scene = smallHome();
  scene.options.scaleNoise(0);
  const Simulator simulator(scene, LabelTable::installed(), 1);
  const auto scan = simulator.frame(0).scan;
  const mrpt::poses::CPose3D pose = simulator.truePoses()[0];
  EXPECT_LT((simulator.odometry().back() - simulator.truePoses().back()).norm(), 1e-6);
  const RenderedFrame rendered =
      RayCaster(simulator.scene(), scene.options.camera.pinhole()).render(pose);
  scan->unprojectInto(*scan);  // by MRPT's own model of camera and depth
  ASSERT_GT(scan->points3D_x.size(), 10000U);
  std::size_t onFloor = 0, wrong = 0;
  for (std::size_t i = 0; i < scan->points3D_x.size(); ++i)
  {
    const Eigen::Vector3d p(
        static_cast<double>(scan->points3D_x[i]), static_cast<double>(scan->points3D_y[i]),
        static_cast<double>(scan->points3D_z[i]));
    const std::size_t pixel =
        scan->points3D_idxs_y[i] * std::size_t{160} + scan->points3D_idxs_x[i];
    if (std::abs(p.x() - static_cast<double>(rendered.depth[pixel])) > 1.01e-4) ++wrong;
    const Eigen::Vector3d world = transformed(pose, p);
    onFloor += std::abs(world.z()) < 0.001;
    EXPECT_GT(world.z(), -0.001) << "nothing below the floor";
  }
  EXPECT_EQ(0U, wrong) << "half of the 0.2 mm unit";
  EXPECT_GT(onFloor, 3000U);
}

TEST(Simulator, WritesNothingWhereItCannot)
{
  const TemporaryFolder folder;
  const std::string message =
      errorOf([&] { simulate(smallHome(), 1, folder.path("missing/a.rawlog")); });
  EXPECT_NE(std::string::npos, message.find("missing/a.rawlog")) << message;
  EXPECT_EQ(0U, folder.fileCount());
}

TEST(SimulatorOptions, NoiseOfEachPartHasItsOwnFactor)
{
  SimulatorOptions options;
  options.rig = {CameraOptions()};
  options.scaleNoise({2, 3, 4, 30});
  const SimulatorOptions before;
  EXPECT_EQ(2 * before.camera.colorNoise, options.camera.colorNoise);
  EXPECT_EQ(2 * before.camera.colorNoise, options.rig[0].colorNoise);
  EXPECT_EQ(3 * before.depthNoise.axialGrowth, options.depthNoise.axialGrowth);
  EXPECT_EQ(3 * before.depthNoise.edgeHoles, options.depthNoise.edgeHoles);
  EXPECT_EQ(before.depthNoise.maxRange, options.depthNoise.maxRange);
  EXPECT_EQ(4 * before.odometry.translationPerMetre, options.odometry.translationPerMetre);
  EXPECT_EQ(4 * before.odometry.scale, options.odometry.scale);
  EXPECT_EQ(30 * before.detector.jitter, options.detector.jitter);
  EXPECT_EQ(30 * before.detector.falseAlarms, options.detector.falseAlarms);
  EXPECT_EQ(1, options.detector.occludedMissRate) << "a share";
  EXPECT_EQ(before.detector.minSize, options.detector.minSize);
}

TEST(BundledRawlog, IsSmallAndFitsItsTruth)
{
  const std::string stem = QUADMAP_SOURCE_DIR "/rawlogs/home";
  std::uintmax_t bytes = 0;
  for (const char* extension : kExtensions) bytes += std::filesystem::file_size(stem + extension);
  EXPECT_LE(bytes, 12'000'000U);

  // The truth is that of the scene file as it is now: whoever changes one makes the other again.
  const auto truth = readObjectsJson(stem + ".objects.gt.json");
  std::size_t next = 0;
  for (const auto& object : homeScene().objects)
  {
    if (object.label.empty()) continue;
    ASSERT_LT(next, truth.size());
    EXPECT_EQ(object.label, truth[next].label);
    EXPECT_LT((object.truth().center() - truth[next].object.center()).norm(), 1e-6);
    EXPECT_GE(truth[next].framesVisible.value_or(0), 10U) << object.name;
    ++next;
  }
  EXPECT_EQ(truth.size(), next);
}

}  // namespace
}  // namespace quadmap::simulator
