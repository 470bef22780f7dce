// Tests a run in the map of an earlier one. It takes another way from another start, with drift,
// and things were moved, taken away and brought.
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "OdometryRecords.h"
#include "RunProgram.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/sensors/RawlogNames.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using nlohmann::json;

namespace
{
const std::string kRoom =
    "[include]\nfile1 = home.ini\n"
    "[camera]\nwidth = 240\nheight = 180\nfocal = 197\n";

const std::string kWay = "[trajectory]\nframes = 100\n";

/** The room at a later time, with changes and much drift. */
const std::string kLater = R"(
[odometry]
translationPerMetre = 0.03
rotationPerMetre_deg = 0.8
[object chair_2]
position = 1.75 -0.75 0
yaw_deg = 160
[object chair_3_turned_away]
to = 0
[object potted_plant_3]
label = potted plant
model = fern
position = 3.05 0.9 0
orientation_defined = no
)";

/** The way of the scene in the other direction, and from another start. */
std::string otherWay()
{
  const mrpt::config::CConfigFile home(QUADMAP_SOURCE_DIR "/share/quadmap/scenes/home.ini");
  constexpr int kStart = 20;
  std::vector<std::string> keys;
  home.getAllKeys("trajectory", keys);
  keys.erase(
      std::remove_if(keys.begin(), keys.end(), [](auto& key) { return key.find("waypoint") != 0; }),
      keys.end());
  std::sort(keys.begin(), keys.end());
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const auto& from = keys[(keys.size() + kStart - i) % keys.size()];
    text += keys[i] + " = " + home.read_string("trajectory", from, "") + "\n";
  }
  return text;
}

class EarlierMap : public ::testing::Test
{
 protected:
  static void expectSuccess(const std::string& program, const std::string& arguments)
  {
    const auto result = runProgram(program, arguments);
    ASSERT_EQ(result.status, 0) << program << " " << arguments << "\n" << result.err;
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  void simulate(const std::string& name, const std::string& scene, int seed) const
  {
    expectSuccess(
        "quadmap-simulate", folder_.write(name + ".ini", scene) + " --seed " +
                                std::to_string(seed) + " -o " + path(name + ".rawlog"));
  }

  /** Lets the odometry of a recording start elsewhere. */
  void moveOdometry(const std::string& name, const CPose3D& T_new_old) const
  {
    auto records = readRecords(path(name + ".rawlog"));
    for (const auto& record : records)
      if (auto* pose = dynamic_cast<mrpt::obs::CObservationRobotPose*>(record.get()))
        if (pose->sensorLabel == kOdometryLabel) pose->pose.mean = T_new_old + pose->pose.mean;
    writeObjects(path(name + ".rawlog"), records);
  }

  /** Root mean square error of the positions of a run, without alignment [m]. */
  double rmse(const std::string& run, const std::string& truth) const
  {
    const auto world = readTumTrajectory(path(truth));
    double sum = 0;
    const auto trajectory = readTumTrajectory(path(run + "/trajectory.tum"));
    for (const auto& p : trajectory)
    {
      const auto there = poseAt(world, p.time, 1);
      EXPECT_TRUE(there);
      if (there) sum += std::pow((p.pose - *there).norm(), 2);
    }
    return std::sqrt(sum / static_cast<double>(trajectory.size()));
  }

  double ate(const std::string& run, const std::string& truth) const
  {
    expectSuccess(
        "quadmap-evaluate",
        path(run) + " --trajectory " + path(truth) + " --json " + path("evaluation.json"));
    return json::parse(readFile(path("evaluation.json")))["trajectory"]["ate_rmse_m"];
  }

  /** Id of the object of a map at the place of a true one. It must have its label. */
  json idOf(const std::string& run, const std::string& truth, const Eigen::Vector3d& at) const
  {
    const auto nearest = [&](const std::string& file)
    {
      const auto objects = readObjectsJson(path(file));
      return *std::min_element(
          objects.begin(), objects.end(),
          [&](const auto& a, const auto& b)
          { return (a.object.center() - at).norm() < (b.object.center() - at).norm(); });
    };
    const auto found = nearest(run + "/objects.json"), real = nearest(truth);
    EXPECT_EQ(found.label, real.label);
    EXPECT_LT((found.object.center() - real.object.center()).norm(), 0.2) << real.label;
    return std::stoi(found.id);
  }

  const TemporaryFolder folder_;
};
}  // namespace

TEST_F(EarlierMap, LaterRunFindsItselfAndWhatChanged)
{
  simulate("first", kRoom + kWay, 1);
  // Poses known, so that the map's frame is the world's
  expectSuccess(
      "quadmap-slam", path("first.rawlog") + " --odometry ground-truth -o " + path("map"));
  simulate("second", kRoom + kLater + kWay + otherWay(), 11);
  moveOdometry("second", CPose3D(3, -1, 0.2, 2.2, 0, 0));
  const std::string second = path("second.rawlog") + " -o ";
  expectSuccess("quadmap-slam", second + path("alone"));
  expectSuccess("quadmap-slam", second + path("in_map") + " --map " + path("map"));

  EXPECT_LE(rmse("in_map", "second.groundtruth.tum"), 1.1 * ate("alone", "second.groundtruth.tum"))
      << "[m]; of the first nothing is aligned: 10 % for what the map's own objects err by";
  const json changes = json::parse(readFile(path("in_map/report.json")))["map_changes"];
  const std::string before = "first.objects.gt.json", after = "second.objects.gt.json";
  ASSERT_EQ(changes["moved"].size(), 1u) << changes;
  EXPECT_EQ(changes["moved"][0]["from"], idOf("map", before, {0.62, -0.72, 0.46}));
  EXPECT_EQ(changes["moved"][0]["to"], idOf("in_map", after, {1.75, -0.75, 0.46}));
  EXPECT_NEAR(changes["moved"][0]["distance_m"], 1.13, 0.2);
  EXPECT_EQ(changes["removed"], json({idOf("map", before, {-1.05, -0.10, 0.46})}));
  EXPECT_EQ(changes["added"], json({idOf("in_map", after, {3.05, 0.90, 0.25})}));
}
