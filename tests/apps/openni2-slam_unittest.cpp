// quadmap-slam openni2: the real OpenNI2, with a driver for a camera that is not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "../detection/TinyDetector.h"
#include "PluggedCamera.h"

using namespace quadmap;
using nlohmann::json;

namespace
{
/** A camera that sees the bundled room. */
class SlamOpenNi2 : public ::testing::Test
{
 protected:
  static void SetUpTestSuite()
  {
    room_ = new TestCamera(cameraOf(std::string(QUADMAP_SOURCE_DIR) + "/rawlogs/home.rawlog", 30));
    room_->fps = 30;
  }
  static void TearDownTestSuite() { delete room_; }

  std::string command(const std::string& arguments) const
  {
    return commandOf(
        "", "quadmap-slam", arguments + " --resolution 320x240 -o " + folder_.path("out"));
  }
  ProgramResult run(const TestCamera& camera, const std::string& arguments) const
  {
    return runCommand(withCamera(camera, folder_) + command(arguments));
  }
  std::string detector() const { return " --detector '" + tiny_.model() + "' "; }
  json report() const { return json::parse(readFile(folder_.path("out/report.json"))); }

  TinyDetector tiny_;
  TemporaryFolder folder_;
  static TestCamera* room_;
};
TestCamera* SlamOpenNi2::room_ = nullptr;
}  // namespace

TEST_F(SlamOpenNi2, MapsWhatTheCameraSees)
{
  const auto result = run(*room_, "openni2:live --frames 45" + detector());
  ASSERT_EQ(result.status, 0) << result.err;
  const json r = report();
  const std::size_t frames = r["input"]["frames"];
  EXPECT_GE(frames, 5u) << "the newest four wait";
  EXPECT_LE(frames, 45u);
  EXPECT_EQ(r["input"]["interrupted"], false);
  EXPECT_EQ(r["input"]["file"], "openni2:live");
  EXPECT_GE(r["input"]["keyframes"], 1);
  EXPECT_EQ(r["input"]["keyframes_without_boxes"], 0) << "the detector looked";
  for (const char* name : {"objects.quadmap", "trajectory.tum", "map.simplemap", "scene.3Dscene"})
    EXPECT_TRUE(std::filesystem::exists(folder_.path(std::string("out/") + name))) << name;
}

TEST_F(SlamOpenNi2, SkipsTheFramesItIsTooSlowFor)
{
  auto camera = *room_;
  camera.fps = 2000;
  const auto result = run(camera, "openni2:live --frames 1000 --method odometry");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("frames skipped"), kNotFound) << result.err;
  const json r = report();
  EXPECT_LT(r["input"]["frames"], 1000);
  EXPECT_NE(r["warnings"].dump().find("frames skipped"), kNotFound);
}

TEST_F(SlamOpenNi2, EndsWithCtrlCAndValidFiles)
{
  auto camera = *room_;
  camera.interruptAfter = 40;
  const auto result = run(camera, "openni2:live --method odometry");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(report()["input"]["interrupted"], false) << "it is how a camera ends";
}

TEST_F(SlamOpenNi2, KeepsWhatWasDoneBeforeTheCameraWasUnplugged)
{
  auto camera = *room_;
  camera.unplugAfter = 25;
  const auto result = run(camera, "openni2:live --method odometry");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("openni2:live: the camera was unplugged"), kNotFound) << result.err;
  EXPECT_EQ(report()["input"]["interrupted"], true);
  EXPECT_GE(report()["input"]["frames"], 5);

  camera.unplugAfter = camera.loseEvery = 1;  // before the first image
  const auto early = run(camera, "openni2:live --method odometry -v error");
  EXPECT_EQ(early.status, 1);
  EXPECT_EQ(std::count(early.err.begin(), early.err.end(), '\n'), 1) << early.err;
}

TEST_F(SlamOpenNi2, ReplaysARecordingInFullAndAlwaysTheSame)
{
  const std::string oni = recordOni(*room_, 12, folder_);
  const std::string arguments = "openni2:'" + oni + "'" + detector();
  std::string first;
  for (int i = 0; i < 2; ++i)
  {
    const auto result = runCommand("LD_LIBRARY_PATH='" + kOpenNi2 + "' " + command(arguments));
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_GE(report()["input"]["frames"], 12);
    const std::string trajectory = readFile(folder_.path("out/trajectory.tum"));
    EXPECT_EQ(trajectory, i == 0 ? trajectory : first);
    first = trajectory;
  }
}

TEST_F(SlamOpenNi2, RefusesARunWithoutBoxesBeforeItBegins)
{
  const auto expectUsage = [&](const std::string& arguments, const std::string& part)
  {
    const auto result = run(*room_, arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(part), kNotFound) << result.err;
  };
  expectUsage("openni2:live", "--detector NAME");
  expectUsage("openni2:live --objects x.rawlog --method odometry", "--objects");
  expectUsage("x.rawlog --frames 3", "--frames");
}

TEST_F(SlamOpenNi2, ShowsOneLineOnATerminal)
{
  const std::string inner =
      withCamera(*room_, folder_) + command("openni2:live --frames 30 -v warn --method odometry");
  const auto result = runCommand("script -qec \"" + inner + "\" " + folder_.path("typescript"));
  ASSERT_EQ(result.status, 0) << result.err << result.out;
  const std::string shown = readFile(folder_.path("typescript"));
  EXPECT_NE(shown.find(" keyframes: no object yet"), kNotFound) << shown;
  EXPECT_GT(std::count(shown.begin(), shown.end(), '\r'), 2) << "written anew: " << shown;
}
