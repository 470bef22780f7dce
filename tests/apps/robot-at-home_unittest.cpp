// A rawlog in the form of those of Robot@Home: four RGB-D sensors, turned upright, whose images are
// in files beside it, and a laser scanner, but no odometry.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "../sensors/SampleRawlog.h"
#include "RunProgram.h"
#include "quadmap/sensors/RawlogWriter.h"

using namespace quadmap;

namespace
{
constexpr const char* kScene = R"([include]
file1 = SHARE/scenes/common/robot-home-room.ini

[camera]
width = 320
height = 240
focal = 262.5

[camera RGBD_1]
position = 0.02 -0.14 0.98
yaw_deg = 0
roll_deg = 90

[camera RGBD_2]
position = 0.10 -0.07 0.98
yaw_deg = -45
roll_deg = 90
delay = 0.009

[camera RGBD_3]
position = 0.02 0.14 0.98
yaw_deg = 90
roll_deg = 90
delay = 0.021

[camera RGBD_4]
position = 0.10 0.07 0.98
yaw_deg = 45
roll_deg = 90
delay = 0.028

[trajectory]
kind = drive
frames = 24
duration = 3
waypoint01 = 1.9 0.3 180
waypoint02 = 1.1 0.3
)";

/** The drive as the recordings have it: see the top of this file. */
class RobotAtHome : public ::testing::Test
{
 protected:
  void SetUp() override
  {
    std::string scene = kScene;
    scene.replace(scene.find("SHARE"), 5, QUADMAP_SOURCE_DIR "/share/quadmap");
    const auto simulated = runProgram(
        "quadmap-simulate",
        folder_.write("scene.ini", scene) + " -o " + folder_.path("drive.rawlog"));
    ASSERT_EQ(simulated.status, 0) << simulated.err;
    writeAsRecorded();
  }

  std::string rawlog() const { return folder_.path("session.rawlog"); }

  TemporaryFolder folder_;

 private:
  void writeAsRecorded() const
  {
    RawlogWriterOptions external;
    external.external = true;
    RawlogWriter images(rawlog(), external);
    std::vector<mrpt::serialization::CSerializable::Ptr> records;
    for (const auto& frame : readAll(folder_.path("drive.rawlog")))
    {
      images.write(*frame.scan);  // which has the names of its files afterwards
      records.push_back(frame.scan);
      auto laser = mrpt::obs::CObservation2DRangeScan::Create();
      laser->timestamp = frame.scan->timestamp;
      laser->sensorLabel = "HOKUYO1";
      laser->resizeScanAndAssign(3, 2.0F, true);
      records.push_back(laser);
      if (frame.objects) images.write(*frame.objects);
    }
    images.finish();
    writeObjects(rawlog(), records);
  }
};
}  // namespace

TEST_F(RobotAtHome, CheckTellsOfItsFourSensors)
{
  const auto checked = runProgram("quadmap-import", "auto " + rawlog() + " --check");
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
  for (const char* part :
       {"frames: 96 of 4 sensors", "RGBD_1: 24 frames, 320x240, fx 262.5", "RGBD_4: 24 frames",
        "roll 90.0 deg", "no odometry", "96 CObservation2DRangeScan", "no problem found"})
    EXPECT_NE(checked.out.find(part), std::string::npos) << part << " is not in: " << checked.out;
}

TEST_F(RobotAtHome, IsMappedWithAllFourSensorsByATrajectoryOfTheRobot)
{
  const auto run = [](const std::string& program, const std::string& arguments)
  {
    const auto result = runProgram(program, arguments);
    EXPECT_EQ(result.status, 0) << program << " " << arguments << "\n" << result.err;
    return result.out;
  };
  const std::string out = folder_.path("out"), complete = folder_.path("x.rawlog"),
                    figures = folder_.path("figures.json"),
                    trajectory = folder_.path("drive.groundtruth.tum");
  run("quadmap-import", "rawlog " + rawlog() + " --trajectory " + trajectory + " -o " + complete);
  EXPECT_EQ(readAll(complete).size(), 96u) << "complete in itself";
  run("quadmap-slam", complete + " --every 1 -o " + out);
  const auto report = nlohmann::json::parse(readFile(out + "/report.json"));
  EXPECT_GE(report["input"]["keyframes"], 90) << "of all sensors, but for the ends";
  run("quadmap-evaluate", out + " --objects " + folder_.path("drive.objects.gt.json") +
                              " --trajectory " + trajectory + " --json " + figures);
  const auto evaluation = nlohmann::json::parse(readFile(figures));
  EXPECT_LT(evaluation["trajectory"]["ate_rmse_m"], 0.03) << "[m], on a way of 0.8 m";
  EXPECT_GE(evaluation["objects"]["matched"], 9) << "of ten: " << evaluation;
}
