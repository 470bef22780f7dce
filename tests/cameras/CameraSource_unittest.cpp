#include <gtest/gtest.h>

#include "../obs/TemporaryFolder.h"
#include "FakeDevice.h"

using namespace quadmap;

namespace
{
std::unique_ptr<FakeDevice> deviceWith(int frames, bool isLive = false)
{
  auto device = std::make_unique<FakeDevice>(isLive);
  for (int i = 0; i < frames; ++i) device->addPair(i);
  return device;
}

std::vector<RgbdFrame> readAll(CameraSource& camera)
{
  std::vector<RgbdFrame> frames;
  while (auto frame = camera.next()) frames.push_back(*frame);
  return frames;
}
}  // namespace

TEST(CameraSource, GivesEveryFrameOfARecordingWithItsTimeAndCalibration)
{
  CameraSource camera("x.oni", deviceWith(100), {});
  const auto frames = readAll(camera);
  ASSERT_EQ(frames.size(), 100u);
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    const auto& scan = *frames[i].scan;
    EXPECT_EQ(frames[i].record, i);
    EXPECT_NEAR(frames[i].time(), 100 + kFakePeriod * static_cast<double>(i), 1e-6);
    EXPECT_EQ(scan.sensorLabel, "camera");
    EXPECT_EQ(scan.rangeImage(2, 3), 1000 + i);
    EXPECT_FLOAT_EQ(scan.rangeUnits, 0.001f);
    EXPECT_TRUE(scan.range_is_depth);
    EXPECT_EQ(scan.cameraParams.fx(), 4);
    EXPECT_EQ(scan.intensityImage.at<std::uint8_t>(0, 0, 2), 3) << "red is the last channel";
  }
  EXPECT_FALSE(camera.failure());
  EXPECT_EQ(camera.lossSummary(), "");
}

TEST(CameraSource, EndsAtTheLimitsOfNumberAndTime)
{
  CameraOptions options;
  options.frames = 7;
  CameraSource byNumber("x.oni", deviceWith(100), options);
  EXPECT_EQ(readAll(byNumber).size(), 7u);
  EXPECT_EQ(byNumber.progress(), 1.0);
  options = {};
  options.duration = 1;
  CameraSource byTime("x.oni", deviceWith(100), options);
  EXPECT_EQ(readAll(byTime).size(), 30u);
  options = {};
  options.isEnded = [asked = 0]() mutable { return ++asked > 10; };
  CameraSource byCaller("x.oni", deviceWith(100), options);
  EXPECT_EQ(readAll(byCaller).size(), 5u) << "it is asked before each of two images";
}

TEST(CameraSource, KeepsTheNewestFramesOfACameraAndCountsTheOthers)
{
  CameraOptions options;
  options.mostWaiting = 4;
  auto device = deviceWith(50, true);
  CameraSource camera("openni2:live", std::move(device), options);
  while (camera.recordsRead() < 50) std::this_thread::yield();
  const auto frames = readAll(camera);  // none was taken before
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames.front().record, 46u);
  EXPECT_EQ(camera.counts().skipped, 46u);
  EXPECT_EQ(camera.counts().frames, 4u);
  EXPECT_NE(camera.lossSummary().find("46 frames skipped"), std::string::npos);
}

TEST(CameraSource, RefusesACalibrationThatNoReaderTakes)
{
  auto device = deviceWith(1, false);
  device->setFocalLength(1e-5);
  const auto error = errorOf([&] { CameraSource("x.oni", std::move(device), CameraOptions()); });
  EXPECT_EQ(error.find("x.oni has an absurd calibration (focal length 1e-05"), 0u) << error;
}

TEST(CameraSource, TellsWhatNeverCame)
{
  auto device = std::make_unique<FakeDevice>(false);
  for (const int number : {0, 1, 4, 5}) device->addPair(number);  // two are lost
  device->images.push_back(fakeImage(DeviceImage::Kind::Depth, 6, 101));
  device->images.push_back(fakeImage(DeviceImage::Kind::Depth, 7, 101.1));
  device->addPair(60);
  CameraSource camera("x.oni", std::move(device), {});
  EXPECT_EQ(readAll(camera).size(), 5u);
  EXPECT_EQ(camera.counts().lost, 2u + 52u);
  EXPECT_EQ(camera.counts().unpaired, 2u);
  EXPECT_EQ(camera.lossSummary(), "54 lost by the camera, 2 without a colour image");
}

TEST(CameraSource, KeepsTheFramesBeforeAFailure)
{
  const auto expectFailure = [](std::unique_ptr<FakeDevice> device, const std::string& part)
  {
    CameraOptions options;
    options.timeout = 0.05;
    CameraSource camera("openni2:live", std::move(device), options);
    EXPECT_EQ(readAll(camera).size(), 3u);
    ASSERT_TRUE(camera.failure());
    EXPECT_EQ(*camera.failure(), "openni2:live: " + part);
  };
  for (const bool isLive : {true, false})
  {
    auto device = deviceWith(3, isLive);
    device->whenEmpty = RgbdDevice::State::Unplugged;
    expectFailure(std::move(device), "the camera was unplugged");
    device = deviceWith(3, isLive);
    device->whenEmpty = RgbdDevice::State::Running;
    expectFailure(std::move(device), "no frame for 0.05 s");
    device = deviceWith(3, isLive);
    device->breaks = true;
    expectFailure(std::move(device), "something broke");
  }
  const std::string cutOff = "the recording is cut off: its end is missing";
  auto device = deviceWith(3, false);
  device->cutOff();
  expectFailure(std::move(device), cutOff);
  device = deviceWith(3, false);
  device->cutOff();
  device->whenEmpty = RgbdDevice::State::Running;
  expectFailure(std::move(device), cutOff + " (no frame for 0.05 s)");
  device = deviceWith(3, false);
  device->cutOff();
  device->breaks = true;
  expectFailure(std::move(device), cutOff + " (something broke)");
}

TEST(CameraSource, StopsWhenItIsNotWantedAnyMore)
{
  auto device = deviceWith(3, true);
  device->whenEmpty = RgbdDevice::State::Running;
  CameraSource camera("openni2:live", std::move(device), {});
  EXPECT_TRUE(camera.next());
}

TEST(CameraSource, GivesBackFramesInTheirOrder)
{
  CameraSource camera("x.oni", deviceWith(4), {});
  std::vector<RgbdFrame> first{*camera.next(), *camera.next()};
  camera.giveBack(first);
  const auto frames = readAll(camera);
  ASSERT_EQ(frames.size(), 4u);
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].record, i);
}

TEST(CameraSource, RefusesOptionsOutOfRange)
{
  const auto refuse = [](const std::function<void(CameraOptions&)>& spoil, const std::string& name)
  {
    CameraOptions options;
    spoil(options);
    EXPECT_EQ(errorOf([&] { check(options); }).find(name), 0u) << name;
  };
  refuse([](CameraOptions& o) { o.width = 0; }, "resolution");
  refuse([](CameraOptions& o) { o.intrinsics = {0, 1, 1, 1}; }, "intrinsics");
  const auto leftHanded = [](CameraOptions& o)
  {
    o.calibration.emplace();
    o.calibration->origin = "icl";
    o.calibration->color.setIntrinsicParamsFromValues(480, -480, 320, 240);
  };
  refuse(leftHanded, "icl: fx and fy must be > 0");
  refuse([](CameraOptions& o) { o.maxPairDelay = 0; }, "maxPairDelay");
  refuse([](CameraOptions& o) { o.duration = -1; }, "duration");
  refuse([](CameraOptions& o) { o.timeout = 0; }, "timeout");
  refuse([](CameraOptions& o) { o.mostWaiting = 0; }, "mostWaiting");
  check(CameraOptions());
}
