#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>

#include "../SceneFixture.h"
#include "noise/SimulatedOdometry.h"
#include "quadmap/simulator/CameraPath.h"

namespace quadmap::simulator
{
namespace
{
/** The poses along the way of a scene, one per frame. */
std::vector<mrpt::poses::CPose3D> pathOf(const Scene& scene, const TrajectoryOptions& options)
{
  std::vector<double> instants;
  for (int frame = 0; frame < options.frames; ++frame) instants.push_back(frame);
  return robotPath(scene, options, instants);
}

/** Angle between the directions in which two cameras look [rad]. */
double turnBetween(const mrpt::poses::CPose3D& a, const mrpt::poses::CPose3D& b)
{
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), zero = Eigen::Vector3d::Zero();
  const Eigen::Vector3d u = transformed(a, x) - transformed(a, zero);
  const Eigen::Vector3d v = transformed(b, x) - transformed(b, zero);
  return std::acos(std::clamp(u.dot(v), -1.0, 1.0));
}

TEST(CameraPath, PassesItsWaypointsLookingAtTheirTargets)
{
  Scene scene = homeScene();
  scene.options.trajectory.frames = 4000;  // 1 cm or 0.5 degrees apart
  scene.options.trajectory.bob = scene.options.trajectory.sway_deg = 0;
  const auto path = pathOf(scene, scene.options.trajectory);
  for (const auto& waypoint : scene.waypoints)
  {
    double best = 1e9, angle = 0;
    for (const auto& pose : path)
    {
      const Eigen::Vector3d eye = transformed(pose, Eigen::Vector3d::Zero());
      const Eigen::Vector3d seen = inverted(pose, waypoint.target).normalized();
      const double off = std::acos(std::clamp(seen.x(), -1.0, 1.0));
      if ((eye - waypoint.eye).norm() + off < best)
        best = (eye - waypoint.eye).norm() + off, angle = off;
      EXPECT_NEAR(0, pose.roll(), 1e-12);
    }
    EXPECT_LT(best, 0.02);
    EXPECT_LT(angle, 0.02);
  }
}

TEST(CameraPath, HomeIsWalkedAtAHumanPace)
{
  const Scene scene = homeScene();
  const auto& options = scene.options.trajectory;
  const auto path = pathOf(scene, options);
  ASSERT_EQ(static_cast<std::size_t>(options.frames), path.size());
  const double seconds = options.duration / options.frames;
  double low = 9, high = 0;
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    low = std::min(low, path[i].z());
    high = std::max(high, path[i].z());
    const auto& next = path[(i + 1) % path.size()];
    EXPECT_LT((next - path[i]).norm(), 1.3 * seconds) << "1.3 m/s; the way is closed";
    EXPECT_LT(turnBetween(path[i], next), mrpt::DEG2RAD(80) * seconds) << i;
  }
  EXPECT_GT(low, 1.2);
  EXPECT_LT(high, 1.65);
}

TEST(CameraPath, FrameCountDoesNotChangeTheWay)
{
  Scene scene = homeScene();
  scene.options.trajectory.bob = scene.options.trajectory.sway_deg = 0;
  auto options = scene.options.trajectory;
  const auto many = pathOf(scene, options);
  options.frames /= 4;
  const auto few = pathOf(scene, options);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_LT((few[i] - many[4 * i]).norm(), 1e-9);
}

TEST(CameraPath, RejectsWaysThroughWallsAndFurniture)
{
  const auto errorFor = [](const std::string& text)
  {
    return errorOf(
        [&]
        {
          const Scene scene = sceneFromText(text);
          pathOf(scene, scene.options.trajectory);
        });
  };
  EXPECT_EQ("", errorFor(kRoomText));
  std::string outside = kRoomText;
  outside.replace(outside.find("0 0.5 1.3  2"), 12, "0 3.5 1.3  2");
  EXPECT_NE(std::string::npos, errorFor(outside).find("outside the room"));
  EXPECT_NE(std::string::npos, errorFor(outside).find("[trajectory] frame"));
  const std::string through =
      kRoomText +
      "[object shelf]\nlabel = none\nposition = 0.5 0 1\npart1 = box 0 0 0 1 1 1 grey\n";
  EXPECT_NE(std::string::npos, errorFor(through).find("[object shelf]"));
  std::string down = kRoomText;
  down.replace(down.find("0 0 1.3  2 0 1.3"), 16, "0 0 1.3  0 0 0.1");
  EXPECT_NE(std::string::npos, errorFor(down).find("straight up or down"));
}

std::vector<mrpt::poses::CPose3D> straightWalk(int steps, double metres)
{
  std::vector<mrpt::poses::CPose3D> poses;
  for (int i = 0; i <= steps; ++i) poses.emplace_back(1 + metres * i / steps, 2, 1.4, 0, 0, 0);
  return poses;
}

TEST(SimulatedOdometry, IsTheTruthWithoutNoise)
{
  SimulatorOptions options;
  options.scaleNoise(0);
  const Scene scene = homeScene();
  const auto truth = pathOf(scene, scene.options.trajectory);
  RandomStream random(1, Purpose::Odometry, 0);
  const auto odometry = driftingOdometry(truth, options.odometry, random);
  ASSERT_EQ(truth.size(), odometry.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT((odometry[i] - truth[i]).norm() + turnBetween(odometry[i], truth[i]), 1e-6);
}

TEST(SimulatedOdometry, DriftGrowsWithTheRootOfTheWayAtAnyFrameRate)
{
  OdometryOptions options;
  options.translationPerMetre = 0.02;
  options.rotationPerMetre_deg = options.rotationPerRadian_deg = 0;
  options.translationPerRadian = options.scale = 0;
  for (const int steps : {4, 64})
  {
    std::vector<double> x, y;
    for (std::uint64_t seed = 0; seed < 1500; ++seed)
    {
      RandomStream random(seed, Purpose::Odometry, 0);
      const auto odometry = driftingOdometry(straightWalk(steps, 9), options, random);
      EXPECT_EQ(1, odometry.front().x()) << "starts at the true pose";
      x.push_back(odometry.back().x() - 10);
      y.push_back(odometry.back().y() - 2);
    }
    // 0.02 m after 1 m: 0.06 m after 9 m. 1500 runs: +- 1.8 % each sigma, 4 of them.
    EXPECT_NEAR(0.06, momentsOf(x).deviation, 0.0045);
    EXPECT_NEAR(0.06, momentsOf(y).deviation, 0.0045);
    EXPECT_NEAR(0, momentsOf(x).mean, 4 * 0.06 / 38.7);
  }
}

TEST(SimulatedOdometry, RotationDriftsWithWayAndTurns)
{
  OdometryOptions options;
  options.translationPerMetre = options.translationPerRadian = options.scale = 0;
  options.rotationPerMetre_deg = 0.3;
  options.rotationPerRadian_deg = 0.4;
  std::vector<mrpt::poses::CPose3D> truth;
  for (int i = 0; i <= 40; ++i) truth.emplace_back(0.1 * i, 0, 1, 0.05 * i, 0, 0);
  std::vector<double> yaw;
  for (std::uint64_t seed = 0; seed < 1500; ++seed)
  {
    RandomStream random(seed, Purpose::Odometry, 0);
    yaw.push_back(mrpt::RAD2DEG(driftingOdometry(truth, options, random).back().yaw() - 2));
  }
  // 4 m and 2 rad: sqrt(4 * 0.3^2 + 2 * 0.4^2) degrees.
  EXPECT_NEAR(std::sqrt(4 * 0.09 + 2 * 0.16), momentsOf(yaw).deviation, 0.061) << "4 sigma";
}

TEST(SimulatedOdometry, ScaleErrorHoldsForTheWholeRun)
{
  OdometryOptions options;
  options.translationPerMetre = options.translationPerRadian = 0;
  options.rotationPerMetre_deg = options.rotationPerRadian_deg = 0;
  options.scale = 0.05;
  RandomStream random(4, Purpose::Odometry, 0);
  const auto odometry = driftingOdometry(straightWalk(10, 5), options, random);
  const double scale = (odometry[1].x() - 1) / 0.5;
  EXPECT_GT(std::abs(scale - 1), 1e-4);
  for (int i = 1; i <= 10; ++i)
    EXPECT_NEAR(1 + 0.5 * i * scale, odometry[static_cast<std::size_t>(i)].x(), 1e-9);
}

}  // namespace
}  // namespace quadmap::simulator
