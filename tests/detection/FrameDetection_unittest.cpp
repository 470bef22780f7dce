#include "quadmap/detection/FrameDetection.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "../sensors/SampleRawlog.h"
#include "TinyDetector.h"
#include "quadmap/obs/FrameAgreement.h"

using namespace quadmap;

namespace
{
/** A scan that is red in the upper left corner of its image, in one square of the detector. */
mrpt::obs::CObservation3DRangeScan::Ptr redCornerScan(unsigned width, unsigned height)
{
  auto scan = sampleScan(kStart);
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), CV_8UC3, cv::Scalar(0, 80, 0));
  image(cv::Rect(0, 0, image.cols / 8, image.rows / 8)).setTo(cv::Scalar(0, 0, 255));
  scan->intensityImage = mrpt::img::CImage(image, mrpt::img::DEEP_COPY);
  return scan;
}

RgbdFrame frameOf(const mrpt::obs::CObservation3DRangeScan::Ptr& scan)
{
  RgbdFrame frame;
  frame.scan = scan;
  return frame;
}
}  // namespace

TEST(FrameDetection, GivesBoxesThatBelongToTheScan)
{
  const TinyDetector tiny;
  const auto detector = loadDetector(tiny.model());
  const auto scan = redCornerScan(kColumns, kRows);
  scan->sensorPose = mrpt::poses::CPose3D(0.1, 0.2, 0.3, 0.4, 0, 0);
  const auto boxes = detectObjects(frameOf(scan), *detector);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->timestamp, scan->timestamp);
  EXPECT_EQ(boxes->sensorLabel, scan->sensorLabel);
  EXPECT_FALSE(mismatch(*boxes, *scan)) << *mismatch(*boxes, *scan);
  ASSERT_EQ(boxes->objects.size(), 1u);
  EXPECT_NEAR(boxes->objects[0].box.x2, 12, 0.1);
  EXPECT_NEAR(boxes->objects[0].box.y2, 9, 0.1);
}

TEST(FrameDetection, GivesBoxesInPixelsOfTheDepthImage)
{
  const TinyDetector tiny;
  const auto detector = loadDetector(tiny.model());
  const auto boxes = detectObjects(frameOf(redCornerScan(4 * kColumns, 4 * kRows)), *detector);
  ASSERT_EQ(boxes->objects.size(), 1u);
  EXPECT_NEAR(boxes->objects[0].box.x2, 12, 0.1);
  EXPECT_NEAR(boxes->objects[0].box.y2, 9, 0.1);
}

TEST(FrameDetection, GivesNoneWithoutColour)
{
  const TinyDetector tiny;
  const auto detector = loadDetector(tiny.model());
  const auto scan = sampleScan(kStart);
  scan->hasIntensityImage = false;
  EXPECT_FALSE(detectObjects(frameOf(scan), *detector));
}

TEST(FrameDetection, LooksAtTurnedImagesAsTheyWereRecorded)
{
  const TinyDetector tiny;
  const auto detector = loadDetector(tiny.model());
  const auto scan = redCornerScan(kColumns, kRows);
  scan->cameraParams.setIntrinsicParamsFromValues(60, -62, 31.5, 20.5);
  scan->cameraParamsIntensity = scan->cameraParams;
  const TemporaryFolder folder;
  const auto frames = readAll(writeObjects(folder.path("x.rawlog"), {scan}));
  ASSERT_EQ(frames.size(), 1u);
  ASSERT_TRUE(frames[0].isTurned);
  const auto boxes = detectObjects(frames[0], *detector);
  ASSERT_TRUE(boxes);
  EXPECT_FALSE(mismatch(*boxes, *frames[0].scan)) << *mismatch(*boxes, *frames[0].scan);
  ASSERT_EQ(boxes->objects.size(), 1u);
  EXPECT_NEAR(boxes->objects[0].box.y1, kRows - 1 - 9, 0.1) << "in the turned image";
  turnUpsideDown(*boxes);
  EXPECT_NEAR(boxes->objects[0].box.y2, 9, 0.1) << "in the recorded image";
  EXPECT_FALSE(mismatch(*boxes, *scan));
}
