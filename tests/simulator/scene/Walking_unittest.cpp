#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <array>
#include <cmath>

#include "../SceneFixture.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/simulator/Simulator.h"

namespace quadmap::simulator
{
namespace
{
const std::string kWalker =
    "[object walker]\nlabel = person\nposition = 2 -1 0\nway1 = 1  2 -1 0  90\n"
    "way2 = 3  2 1 0  90\nway3 = 4  1 1 0  180\npart1 = box 0 0 0.9 0.3 0.3 1.8 grey\n";

TEST(Walking, GoesEvenlyFromPointToPoint)
{
  const Scene scene = sceneFromText(kRoomText + kWalker);
  const SceneObject& walker = scene.objects.at(0);
  for (const auto& [time, x, y, yaw] : {
           std::array{0.0, 2.0, -1.0,  90.0},
           {2.0, 2.0,  0.0,  90.0},
           {2.5, 2.0,  0.5,  90.0},
           {3.5, 1.5,  1.0, 135.0},
           {9.0, 1.0,  1.0, 180.0}
  })
  {
    const auto pose = walker.poseAt(time);
    EXPECT_NEAR(x, pose.x(), 1e-12) << time;
    EXPECT_NEAR(y, pose.y(), 1e-12) << time;
    EXPECT_NEAR(0, std::sin((mrpt::DEG2RAD(yaw) - pose.yaw()) / 2), 1e-12) << time;
  }
  // The middle of the image shows it when it passes, and the wall before.
  const RayCaster caster(scene, smallCamera());
  const std::size_t middle = 60 * 160 + 80;
  EXPECT_NEAR(3, caster.render(lookingAhead(), 1).depth[middle], 1e-3);
  EXPECT_NEAR(1.85, caster.render(lookingAhead(), 2).depth[middle], 1e-3);
}

TEST(Walking, HasNoPlaceInTheTruth)
{
  const Scene scene = sceneFromText(
      kRoomText + kWalker +
      "[object cup]\nlabel = cup\nposition = 1.5 0 1\npart1 = box 0 0 0.1 0.2 0.2 0.2 grey\n");
  const TemporaryFolder folder;
  const Simulator simulator(scene, LabelTable::installed(), 1);
  simulateToFiles(simulator, folder.path("a.rawlog"));
  const auto truth = readObjectsJson(folder.path("a.objects.gt.json"));
  ASSERT_EQ(1U, truth.size());
  EXPECT_EQ("cup", truth[0].label);
}

TEST(Walking, RejectsAWayThatGoesBackInTime)
{
  EXPECT_THROW(
      sceneFromText(
          kRoomText + "[object x]\nlabel = person\nposition = 2 0 0\nway1 = 2 2 0 0 0\n"
                      "way2 = 1 2 1 0 0\npart1 = box 0 0 0.9 0.3 0.3 1.8 grey\n"),
      std::runtime_error);
}

}  // namespace
}  // namespace quadmap::simulator
