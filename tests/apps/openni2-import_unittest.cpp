// quadmap-import openni2: the real OpenNI2, with a driver for a camera that is not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "PluggedCamera.h"

using namespace quadmap;

namespace
{
class ImportOpenNi2 : public ::testing::Test
{
 protected:
  ProgramResult import(const TestCamera& camera, const std::string& arguments) const
  {
    return runCommand(command(withCamera(camera, camera_), arguments));
  }
  ProgramResult importOni(const std::string& file, const std::string& arguments = "") const
  {
    return runCommand(
        command("LD_LIBRARY_PATH='" + kOpenNi2 + "' ", "'" + file + "' " + arguments));
  }
  std::string command(const std::string& environment, const std::string& arguments) const
  {
    return commandOf(environment, "quadmap-import", "openni2 " + arguments + " -o " + rawlog());
  }
  std::string rawlog() const { return out_.path("x.rawlog"); }
  std::vector<RgbdFrame> frames() const { return readAll(rawlog()); }

  /** One line of error, and nothing that was written. */
  void expectRefusal(const ProgramResult& result, int status, const std::string& part) const
  {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(part), kNotFound) << "'" << part << "' is not in: " << result.err;
    EXPECT_EQ(out_.fileCount(), 0u);
  }

  TemporaryFolder out_, camera_;
};

/** The number of a marked frame, if depth and colour have the same. */
int numberOf(const RgbdFrame& frame)
{
  const int number = frame.scan->rangeImage(0, 0) - 1000;
  const int grey = frame.scan->intensityImage.at<std::uint8_t>(kMark / 2, kMark / 2, 0);
  EXPECT_NEAR(grey, 4 * number, 2) << "colour of another frame";
  return number;
}
}  // namespace

TEST_F(ImportOpenNi2, WritesTheFramesOfTheCamera)
{
  const auto camera = markedCamera(60);
  const auto result = import(camera, "live --resolution 64x48 --frames 30");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("30 frames written"), kNotFound) << result.out;
  EXPECT_EQ(out_.fileCount(), 1u) << "no boxes";
  const auto written = frames();
  ASSERT_EQ(written.size(), 30u);
  for (std::size_t i = 1; i < written.size(); ++i)
  {
    EXPECT_GT(numberOf(written[i]), numberOf(written[i - 1]));
    EXPECT_GT(written[i].time(), written[i - 1].time());
  }
  EXPECT_NEAR(written.back().time(), mrpt::Clock::nowDouble(), 60) << "[s], wall time";
  const auto& scan = *written.front().scan;
  EXPECT_EQ(scan.sensorLabel, "camera");
  EXPECT_NEAR(scan.cameraParams.fx(), 32 / std::tan(0.5), 1e-4);
  EXPECT_NEAR(scan.cameraParams.fy(), 24 / std::tan(0.4), 1e-4);
  EXPECT_EQ(scan.cameraParams.cx(), 31.5);
  EXPECT_EQ(scan.cameraParams.cy(), 23.5);
}

TEST_F(ImportOpenNi2, EndsAtItsDuration)
{
  const auto result = import(markedCamera(60), "live --resolution 64x48 --duration 0.2");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto written = frames();
  ASSERT_GT(written.size(), 1u);
  EXPECT_LE(written.size(), 20u) << "of 100 a second";
}

TEST_F(ImportOpenNi2, EndsWithCtrlCAndAValidFile)
{
  auto camera = markedCamera(60);
  camera.interruptAfter = 20;
  const auto result = import(camera, "live --resolution 64x48");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_GT(frames().size(), 1u);
}

TEST_F(ImportOpenNi2, KeepsWhatCameBeforeTheCameraWasUnplugged)
{
  auto camera = markedCamera(60);
  camera.unplugAfter = 20;
  const auto result = import(camera, "live --resolution 64x48");
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("openni2:live: the camera was unplugged"), kNotFound) << result.err;
  const auto written = frames();
  EXPECT_GT(written.size(), 10u);
  EXPECT_LE(written.size(), 20u);
  for (const auto& frame : written) numberOf(frame);
}

TEST_F(ImportOpenNi2, CountsTheFramesThatNeverCame)
{
  auto camera = markedCamera(60);
  camera.loseEvery = 5;
  const auto result = import(camera, "live --resolution 64x48 --frames 20");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find(" lost by the camera"), kNotFound) << result.out;
}

TEST_F(ImportOpenNi2, TellsThatThereIsNoDriverOrNoCamera)
{
  const std::string without = "LD_LIBRARY_PATH='" + kOpenNi2WithoutDriver + "' ";
  expectRefusal(runCommand(command(without, "live")), 1, "OpenNI2 has no driver for any camera");
  const std::string unplugged = "LD_LIBRARY_PATH='" + kOpenNi2 + "' ";
  expectRefusal(runCommand(command(unplugged, "live")), 1, "openni2:live: no camera found");
  auto camera = markedCamera(2);
  camera.unplugAfter = 1;
  camera.loseEvery = 1;
  expectRefusal(import(camera, "live --resolution 64x48"), 1, "the camera was unplugged");
}

TEST_F(ImportOpenNi2, RefusesWhatTheCameraCannotDo)
{
  const auto camera = markedCamera(2);
  expectRefusal(import(camera, "live"), 1, "has no depth images of 640x480; there are: 64x48");
  expectRefusal(import(camera, "live --resolution 64"), 2, "--resolution: 64 is not like");
  expectRefusal(import(camera, "live --intrinsics 1,2"), 2, "--intrinsics: 1,2 is not like");
  expectRefusal(import(camera, "live --frames -1"), 2, "--frames");
  expectRefusal(import(camera, "live --check"), 2, "--check");
  expectRefusal(import(camera, "nothing.oni"), 1, "nothing.oni: no such file");
}

TEST_F(ImportOpenNi2, TellsThatDepthIsNotRegistered)
{
  auto camera = markedCamera(60);
  camera.registers = 0;
  const auto result = import(camera, "live --resolution 64x48 --frames 3 --intrinsics 50,51,30,20");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("does not register depth to colour"), kNotFound) << result.err;
  EXPECT_EQ(frames().front().scan->cameraParams.fy(), 51);
}

TEST_F(ImportOpenNi2, TakesTheCalibrationOfAKnownCamera)
{
  const auto camera = markedCamera(60);
  const std::string live = "live --resolution 64x48 --frames 3 --camera ";
  expectRefusal(import(camera, live + "fr1"), 1, "camera fr1 distorts, and images of a device");
  expectRefusal(import(camera, live + "kinekt"), 1, "kinekt: no such camera");
  const auto result = import(camera, live + "kinect");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NEAR(frames().front().scan->cameraParams.fx(), 52.5, 1e-9) << "a tenth of 640x480";
}

TEST_F(ImportOpenNi2, TakesOneCalibrationAlone)
{
  const auto camera = markedCamera(2);
  expectRefusal(
      import(camera, "live --resolution 64x48 --camera kinect --intrinsics 50,51,30,20"), 2,
      "--intrinsics, --camera: give only one of them");
}

TEST_F(ImportOpenNi2, UnderstandsColourOfPairsOfPixels)
{
  auto camera = markedCamera(60);
  for (int i = 0; i < camera.frames; ++i)  // the lower half is orange
  {
    auto* color = camera.images.data() + (camera.color(i) - camera.images.data());
    for (int k = camera.width * camera.height / 2; k < camera.width * camera.height; ++k)
      for (int channel = 0; channel < 3; ++channel)
        color[3 * k + channel] = static_cast<std::uint8_t>(channel == 0 ? 220 : 120 - 50 * channel);
  }
  for (const int format : {1, 2})
  {
    SCOPED_TRACE(format);
    camera.colorFormat = format;
    ASSERT_EQ(import(camera, "live --resolution 64x48 --frames 5").status, 0);
    const auto written = frames();
    ASSERT_EQ(written.size(), 5u);
    for (const auto& frame : written)
    {
      EXPECT_GE(numberOf(frame), 0);
      const std::uint8_t* pixel = frame.scan->intensityImage.ptr<std::uint8_t>(40, 40);
      EXPECT_NEAR(pixel[2], 220, 6) << "red; brightness and colour are rounded, and JPEG";
      EXPECT_NEAR(pixel[1], 70, 6) << "green";
      EXPECT_NEAR(pixel[0], 20, 6) << "blue";
    }
  }
}

TEST_F(ImportOpenNi2, TellsThatARecordingWasCutOff)
{
  const std::string oni = recordOni(markedCamera(60), 30, camera_);
  const std::string bytes = readFile(oni);
  const auto cut = [&](std::size_t percent)
  { return importOni(camera_.write("cut.oni", bytes.substr(0, bytes.size() * percent / 100))); };
  // OpenNI2 itself does not open a file that lacks images.
  expectRefusal(cut(20), 1, "cut.oni: OpenNI2 cannot open it: it is no recording, or was cut off");
  ASSERT_EQ(importOni(oni).status, 0);
  const std::size_t all = frames().size();
  std::filesystem::remove(rawlog());
  const auto result = cut(98);  // without the tables at its end
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err.find("cut off"), kNotFound) << "no image is missing: " << result.err;
  EXPECT_NE(result.out.find(std::to_string(all) + " frames written"), kNotFound) << result.out;
  const auto written = frames();
  EXPECT_EQ(written.size(), all);
  for (const auto& frame : written) numberOf(frame);
}

TEST_F(ImportOpenNi2, ReplaysARecordingFrameByFrame)
{
  const std::string oni = recordOni(markedCamera(60), 30, camera_);
  const auto result = importOni(oni);
  ASSERT_EQ(result.status, 0) << result.err;
  const auto written = frames();
  ASSERT_GE(written.size(), 30u);
  for (std::size_t i = 0; i < written.size(); ++i)
  {
    EXPECT_EQ(numberOf(written[i]), numberOf(written[0]) + static_cast<int>(i));
    EXPECT_NEAR(written[i].time() - written[0].time(), 0.01 * static_cast<double>(i), 1e-5);
  }
  const std::string first = readFile(rawlog());
  ASSERT_EQ(importOni(oni).status, 0);
  EXPECT_TRUE(readFile(rawlog()) == first) << "equal content gives equal bytes";
  ASSERT_EQ(importOni(oni, "--frames 10 --every 2").status, 0);
  EXPECT_EQ(frames().size(), 5u);
}

TEST_F(ImportOpenNi2, UndoesAMirror)
{
  auto camera = markedCamera(60);
  const auto swapColumns = [&](int frame, std::size_t offset, int bytes)
  {
    auto* image = camera.images.data() + (camera.depth(frame) - camera.images.data()) + offset;
    for (int row = 0; row < camera.height; ++row, image += bytes * camera.width)
      for (int u = 0; u < camera.width / 2; ++u)
        std::swap_ranges(
            image + bytes * u, image + bytes * (u + 1), image + bytes * (camera.width - 1 - u));
  };
  for (int i = 0; i < camera.frames; ++i)
  {
    swapColumns(i, 0, 2);
    swapColumns(i, camera.depthBytes(), 3);
  }
  camera.mirrors = 1;
  ASSERT_EQ(import(camera, "live --resolution 64x48 --frames 5").status, 0);
  for (const auto& frame : frames()) EXPECT_GE(numberOf(frame), 0);
  ASSERT_EQ(importOni(recordOni(camera, 10, camera_)).status, 0);
  for (const auto& frame : frames()) EXPECT_GE(numberOf(frame), 0);
}

TEST_F(ImportOpenNi2, RefusesAFileThatIsNoRecording)
{
  expectRefusal(importOni(camera_.write("x.oni", "nonsense")), 1, "x.oni: OpenNI2 cannot open it");
}
