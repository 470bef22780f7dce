#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <map>
#include <set>

#include "../SceneFixture.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/sensors/RawlogSource.h"
#include "quadmap/simulator/CameraPath.h"
#include "quadmap/simulator/Simulator.h"

namespace quadmap::simulator
{
namespace
{
const std::string kEmptyRoom =
    "[room]\nsize = 6 6 2.6\nfloor = grey\nwalls = grey\nceiling = grey\n"
    "[material grey]\ncolor = 128 128 128\n"
    "[object box]\nlabel = suitcase\nposition = 2 0.8 0\npart1 = box 0 0 0.3 0.3 0.4 0.6 grey\n";

const std::string kDrive =
    "[trajectory]\nkind = drive\nframes = 6\nduration = 3\nwaypoint1 = -2 0\nwaypoint2 = 0 0.2\n"
    "waypoint3 = 0.5 1\n";

const std::string kRig =
    "[camera]\nwidth = 160\nheight = 120\nfocal = 130\n"
    "[camera left]\nposition = 0.1 0.2 0.9\nyaw_deg = 40\npitch_deg = 15\n"
    "[camera right]\nposition = 0.1 -0.2 0.8\nyaw_deg = -35\nroll_deg = 10\nwidth = 128\n"
    "height = 96\nfocal = 100\ndelay = 0.03\n";

const std::string kMast = "[camera]\nposition = 0 0 1\n";

Simulator simulatorOf(const std::string& text)
{
  return Simulator(sceneFromText(text), LabelTable::installed(), 1);
}

TEST(Rig, EveryCameraIsWrittenWithItsPoseSizeAndTime)
{
  const TemporaryFolder folder;
  Scene scene = sceneFromText(kEmptyRoom + kDrive + kRig);
  scene.options.scaleNoise(0);
  const auto summary =
      simulateToFiles(Simulator(scene, LabelTable::installed(), 1), folder.path("a.rawlog"));
  EXPECT_EQ(12U, summary.frames);
  EXPECT_EQ(12U, readTumTrajectory(folder.path("a.groundtruth.tum")).size()) << "every time";

  RawlogSource source(folder.path("a.rawlog"), RawlogSourceOptions());
  std::map<std::string, unsigned> frames;
  for (double last = 0; const auto frame = source.next();)
  {
    const std::string name = frame->scan->sensorLabel;
    const bool left = name == "left";
    const unsigned n = frames[name]++;
    EXPECT_NEAR(1.6e9 + 0.5 * n + (left ? 0 : 0.03), frame->time(), 1e-6);
    EXPECT_GT(frame->time(), last);
    last = frame->time();
    ASSERT_TRUE(frame->objects) << "boxes come with the label and time of their scan";
    EXPECT_EQ(name, frame->objects->sensorLabel);
    EXPECT_EQ(left ? 160U : 128U, frame->scan->cameraParams.ncols);
    EXPECT_EQ(left ? 130 : 100, frame->scan->cameraParams.fx());
    const auto& pose = frame->scan->sensorPose;
    EXPECT_NEAR(left ? 0.2 : -0.2, pose.y(), 1e-6);
    EXPECT_NEAR(left ? 0.9 : 0.8, pose.z(), 1e-6);
    EXPECT_NEAR(mrpt::DEG2RAD(left ? 40.0 : -35.0), pose.yaw(), 1e-6);
    EXPECT_NEAR(mrpt::DEG2RAD(left ? 15.0 : 0.0), pose.pitch(), 1e-6);
    EXPECT_NEAR(mrpt::DEG2RAD(left ? 0.0 : 10.0), pose.roll(), 1e-6);
    ASSERT_TRUE(frame->T_world_robot && frame->T_odom_robot);
    EXPECT_NEAR(0, frame->T_world_robot->z(), 1e-9) << "poses are those of the robot, on the floor";
    EXPECT_NEAR(0, frame->T_world_robot->pitch(), 1e-9);

    // What the camera sees fits its pose: MRPT's points, taken to the world, lie on the surfaces.
    mrpt::obs::T3DPointsProjectionParams projection;
    projection.takeIntoAccountSensorPoseOnRobot = true;
    frame->scan->unprojectInto(*frame->scan, projection);
    std::size_t onFloor = 0;
    for (std::size_t i = 0; i < frame->scan->points3D_x.size(); ++i)
    {
      const Eigen::Vector3d p = transformed(
          *frame->T_world_robot, {static_cast<double>(frame->scan->points3D_x[i]),
                                  static_cast<double>(frame->scan->points3D_y[i]),
                                  static_cast<double>(frame->scan->points3D_z[i])});
      EXPECT_TRUE(p.z() > -1e-3 && p.cwiseAbs().head<2>().maxCoeff() < 3.001) << p.transpose();
      onFloor += std::abs(p.z()) < 1e-3;
    }
    EXPECT_GT(onFloor, 500U);
  }
  EXPECT_EQ(6U, frames["left"]);
  EXPECT_EQ(6U, frames["right"]);
  EXPECT_TRUE(source.problems().empty());
}

TEST(Rig, CamerasWithoutDelayShareOnePoseOfTheRobot)
{
  const TemporaryFolder folder;
  std::string rig = kRig;
  rig.erase(rig.find("delay"));
  const Simulator simulator = simulatorOf(kEmptyRoom + kDrive + rig);
  ASSERT_EQ(12U, simulator.frameCount());
  for (std::size_t i = 0; i < 12; i += 2)
  {
    EXPECT_EQ("left", simulator.camera(i).name);
    EXPECT_EQ("right", simulator.camera(i + 1).name);
    EXPECT_EQ(simulator.time(i), simulator.time(i + 1));
    EXPECT_LT((simulator.odometry()[i] - simulator.odometry()[i + 1]).norm(), 1e-9);
  }
  simulateToFiles(simulator, folder.path("a.rawlog"));
  EXPECT_EQ(6U, readTumTrajectory(folder.path("a.groundtruth.tum")).size());
}

TEST(Rig, ResizingKeepsTheFieldOfViewOfEachCamera)
{
  SimulatorOptions options = sceneFromText(kEmptyRoom + kDrive + kRig).options;
  options.resize(320, 240);
  ASSERT_EQ(2U, options.cameras().size());
  EXPECT_EQ(260, options.cameras()[0].focal);
  EXPECT_EQ(250, options.cameras()[1].focal);
  EXPECT_EQ(320U, options.cameras()[1].pinhole().width);
}

TEST(Rig, InstalledRigsHaveTwoAndFourCameras)
{
  for (const auto& [file, count] : {
           std::pair{ "common/rig-two.ini", 2U},
           {"common/rig-four.ini", 4U}
  })
  {
    const Scene scene = sceneFromText(kEmptyRoom + kDrive + "[include]\nfile1 = " + file + "\n");
    const auto cameras = scene.options.cameras();
    ASSERT_EQ(count, cameras.size());
    std::set<std::string> names;
    std::set<double> delays;
    for (const auto& camera : cameras)
    {
      names.insert(camera.name);
      delays.insert(camera.delay);
      EXPECT_EQ(320, camera.width);
      EXPECT_GT(camera.position.z(), 0.5);
    }
    EXPECT_EQ(count, names.size());
    EXPECT_EQ(count, delays.size());
  }
}

std::vector<mrpt::poses::CPose3D> pathOf(const std::string& trajectory, int frames)
{
  Scene scene = sceneFromText(kEmptyRoom + trajectory);
  scene.options.trajectory.frames = frames;
  std::vector<double> instants;
  for (int i = 0; i < frames; ++i) instants.push_back(i);
  return robotPath(scene, scene.options.trajectory, instants);
}

TEST(Drive, StaysOnTheFloorAndPassesItsWaypoints)
{
  const auto path = pathOf(kDrive + kMast, 400);
  EXPECT_NEAR(-2, path.front().x(), 1e-9);
  EXPECT_NEAR(0.5, path.back().x(), 1e-9);
  EXPECT_NEAR(1, path.back().y(), 1e-9);
  double nearest = 9;
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    EXPECT_EQ(0, path[i].z());
    EXPECT_NEAR(0, std::abs(path[i].pitch()) + std::abs(path[i].roll()), 1e-12);
    nearest = std::min(nearest, std::hypot(path[i].x(), path[i].y() - 0.2));
    if (i == 0) continue;
    const mrpt::poses::CPose3D step = path[i] - path[i - 1];
    EXPECT_LT(step.norm(), 0.02) << "even pace: 3 m and a turn in 400 steps";
    EXPECT_GT(step.x(), 0) << "forwards";
    EXPECT_LT(std::abs(step.y()), 0.35 * step.x()) << "nearly where it looks";
  }
  EXPECT_LT(nearest, 0.01);
}

TEST(Drive, TurnsOnTheSpotAndTakesHeadings)
{
  const auto path = pathOf(
      "[trajectory]\nkind = drive\nwaypoint1 = 0 0\nwaypoint2 = 1 0\nwaypoint3 = 1 0\n"
      "waypoint4 = 1 1\nwaypoint5 = 1 1 -170\n" +
          kMast,
      300);
  double yawAtCorner = 0;
  for (const auto& pose : path)
  {
    // The ways along the axes are straight.
    EXPECT_LT(std::min(std::abs(pose.y()), std::abs(pose.x() - 1)), 1e-9);
    if (std::abs(pose.x() - 1) < 1e-9 && std::abs(pose.y()) < 1e-9)
      yawAtCorner = std::max(yawAtCorner, pose.yaw());
    else if (pose.x() < 0.999 || pose.y() < 0.999)
    {
      EXPECT_NEAR(pose.x() < 0.999 ? 0 : M_PI / 2, pose.yaw(), 1e-6);
    }
  }
  EXPECT_GT(yawAtCorner, 1.4);
  EXPECT_NEAR(mrpt::DEG2RAD(-170.0), path.back().yaw(), 1e-6);
  double turned = 0;
  for (std::size_t i = 1; i < path.size(); ++i) turned += std::abs((path[i] - path[i - 1]).yaw());
  EXPECT_NEAR(mrpt::DEG2RAD(190.0), turned, 1e-6) << "the short way round: 90 + 100 degrees";
}

TEST(Drive, RejectsWaysThroughFurniture)
{
  const std::string low =
      "[object pouffe]\nlabel = none\nposition = -2 0.05 0\npart1 = box 0 0 0.2 0.4 0.4 0.4 grey\n";
  const auto error = [&](const std::string& more)
  { return errorOf([&] { simulatorOf(kEmptyRoom + kDrive + kRig + more); }); };
  EXPECT_EQ("", error(""));
  EXPECT_NE(std::string::npos, error(low).find("[object pouffe]")) << "although the cameras pass";
  std::string lamp = low;
  lamp.replace(lamp.find("-2 0.05 0"), 9, "-2 0.05 2");
  EXPECT_EQ("", error(lamp)) << "it drives below";
}

TEST(Approach, GoesStraightToTheTarget)
{
  const auto path = pathOf(
      "[trajectory]\nkind = approach\nbob = 0\nsway_deg = 0\nwaypoint1 = -2 -1 1.4  2 0.8 0.3\n"
      "waypoint2 = 1 0.35 0.9  2 0.8 0.3\n",
      50);
  const Eigen::Vector3d first(-2, -1, 1.4), last(1, 0.35, 0.9), target(2, 0.8, 0.3);
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    const Eigen::Vector3d eye = transformed(path[i], Eigen::Vector3d::Zero());
    EXPECT_LT((eye - first).cross(last - first).norm() / (last - first).norm(), 1e-9);
    const Eigen::Vector3d seen = inverted(path[i], target).normalized();
    EXPECT_NEAR(1, seen.x(), 1e-9) << "looks at it";
  }
  EXPECT_LT((transformed(path.back(), Eigen::Vector3d::Zero()) - last).norm(), 1e-9);
}

TEST(SceneInclude, TakesSectionsFromOtherFilesAndKeepsItsOwn)
{
  const TemporaryFolder folder;
  folder.write(
      "models.ini",
      "[material grey]\ncolor = 1 2 3\n[material red]\ncolor = 200 0 0\n"
      "[model ball]\npart1 = ellipsoid 0 0 0.1 0.2 0.2 0.2 red\n[include]\nfile1 = scene.ini\n");
  const auto path = folder.write(
      "scene.ini", "[include]\nfile1 = models.ini\n" + kEmptyRoom + kDrive +
                       "[object ball]\nlabel = sports ball\nmodel = ball\nposition = 1 0 0\n");
  const Scene scene = readScene(path);
  ASSERT_EQ(2U, scene.objects.size());
  EXPECT_EQ("red", scene.materials[scene.objects[0].parts[0].material].name);
  EXPECT_EQ(128, scene.materials[scene.room.floor].color.x()) << "its own grey";
}

TEST(SceneInclude, EarlierNumbersCountFirst)
{
  const TemporaryFolder folder;
  std::string include = "[include]\n";
  for (const int number : {10, 2})
  {
    const std::string name = mrpt::format("file%d.ini", number);
    folder.write(name, mrpt::format("[material red]\ncolor = %d 0 0\n", number));
    include += mrpt::format("file%d = %s\n", number, name.c_str());
  }
  const Scene scene = readScene(folder.write("scene.ini", include + kEmptyRoom + kDrive));
  ASSERT_EQ("red", scene.materials.at(1).name);
  EXPECT_EQ(2, scene.materials[1].color.x());
}

TEST(SceneInclude, MessagesNameTheFileWithTheMistake)
{
  const TemporaryFolder folder;
  const auto error = [&](const std::string& models, const std::string& include)
  {
    folder.write("models.ini", models);
    const auto path =
        folder.write("scene.ini", "[include]\n" + include + "\n" + kEmptyRoom + kDrive);
    return errorOf([&] { readScene(path); });
  };
  EXPECT_EQ("", error("", "file1 = models.ini"));
  for (const auto& [models, include, part] : {
           std::tuple{
                      "[material x]\ncolor = 1 2\n",       "file1 = models.ini","models.ini: [material x]"                                                                                   },
           {"[material x]\ncolour = 1 2 3\n",       "file1 = models.ini",                    "models.ini: [material x]"},
           {                              "",         "file1 = none.ini",         "scene.ini: [include] file1=none.ini"},
           {                              "", "file_models = models.ini",
                      "scene.ini: [include] file_models=models.ini: the key must be"                                             },
           {                              "",      "models = models.ini", "scene.ini: [include] unknown key \"models\""},
           {                      "nonsense",       "file1 = models.ini",                                "models.ini:1"}
  })
    EXPECT_NE(std::string::npos, error(models, include).find(part)) << error(models, include);
}

}  // namespace
}  // namespace quadmap::simulator
