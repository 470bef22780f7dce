#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "../SampleRawlog.h"
#include "quadmap/sensors/RgbdScan.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using Objects = std::vector<mrpt::serialization::CSerializable::Ptr>;

namespace
{
constexpr int kMoments = 40;
const char* const kSensors[] = {"RGBD_1", "RGBD_2", "RGBD_3", "RGBD_4"};

/** Time of a sensor at a moment. Each sensor is a little later than the one before. */
double timeOf(int moment, std::size_t sensor)
{
  return kStart + 0.1 * moment + 0.012 * static_cast<double>(sensor);
}

/** Records of a robot with four cameras that drives along x at 1 m/s. */
Objects fourCameras()
{
  Objects records;
  for (int i = 0; i <= kMoments; ++i)
  {
    records.push_back(samplePose(kStart + 0.1 * i, CPose3D(0.1 * i, 0, 0, 0, 0, 0)));
    for (std::size_t s = 0; s < std::size(kSensors) && i < kMoments; ++s)
      records.push_back(sampleScan(timeOf(i, s), kSensors[s]));
  }
  return records;
}

/** The boxes of the cameras. The first box of each tells which ones they are. */
Objects theirBoxes()
{
  Objects records;
  for (int i = 0; i < kMoments; ++i)
    for (std::size_t s = 0; s < std::size(kSensors); ++s)
    {
      const auto boxes = sampleBoxes(timeOf(i, s), kSensors[s]);
      boxes->objects[0].label = std::to_string(i) + kSensors[s];
      records.push_back(boxes);
    }
  return records;
}

void expectAllPaired(const std::vector<RgbdFrame>& frames)
{
  ASSERT_EQ(frames.size(), kMoments * std::size(kSensors));
  for (std::size_t k = 0; k < frames.size(); ++k)
  {
    const std::string sensor = kSensors[k % std::size(kSensors)];
    ASSERT_EQ(frames[k].scan->sensorLabel, sensor);
    ASSERT_TRUE(frames[k].objects) << "frame " << k;
    EXPECT_EQ(
        frames[k].objects->objects[0].label, std::to_string(k / std::size(kSensors)) + sensor);
    ASSERT_TRUE(frames[k].T_odom_robot) << "frame " << k;
    EXPECT_NEAR(frames[k].T_odom_robot->x(), frames[k].time() - kStart, 1e-6)
        << "where the robot was when this sensor looked";
  }
}

mrpt::obs::CObservation3DRangeScan::Ptr labelledScan(double time, const std::string& sensor)
{
  auto scan = sampleScan(time, sensor);
  scan->pixelLabels = std::make_shared<mrpt::obs::TPixelLabelInfo<2>>();
  scan->pixelLabels->setSize(kRows, kColumns);
  scan->pixelLabels->setLabelName(3, "chair_1");
  scan->pixelLabels->setLabelName(9, "floor_1");
  for (int row = 10; row < 30; ++row)
    for (int column = 20; column < 40; ++column)
      scan->pixelLabels->setLabel(row, column, row < 20 ? 3 : 9);
  return scan;
}

RawlogSourceOptions withPixelLabels()
{
  RawlogSourceOptions options;
  options.pixelLabelClasses = LabelTable::installed();
  return options;
}
}  // namespace

TEST(SeveralSensors, AreInterpolatedAndPairedEachForItself)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), fourCameras());
  writeObjects(folder.path("x.objects.rawlog"), theirBoxes());
  expectAllPaired(readAll(file));
}

TEST(SeveralSensors, SidecarMayStandInAnyOrder)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), fourCameras());
  const auto sensorOf = [](const auto& object)
  { return std::dynamic_pointer_cast<CObservationObjects>(object)->sensorLabel; };
  Objects boxes = theirBoxes();
  std::stable_sort(
      boxes.begin(), boxes.end(),
      [&](const auto& a, const auto& b) { return sensorOf(a) > sensorOf(b); });
  writeObjects(folder.path("x.objects.rawlog"), boxes);
  expectAllPaired(readAll(file));
  std::shuffle(boxes.begin(), boxes.end(), std::mt19937(1));
  writeObjects(folder.path("x.objects.rawlog"), boxes);
  expectAllPaired(readAll(file));
}

TEST(SeveralSensors, WithOneTimeStampKeepTheirBoxes)
{
  const TemporaryFolder folder;
  Objects scans, boxes;
  for (const auto* sensor : kSensors)
  {
    scans.push_back(sampleScan(kStart, sensor));
    boxes.insert(boxes.begin(), sampleBoxes(kStart, sensor));
    std::dynamic_pointer_cast<CObservationObjects>(boxes[0])->objects[0].label = sensor;
  }
  const auto file = writeObjects(folder.path("x.rawlog"), scans);
  writeObjects(folder.path("x.objects.rawlog"), boxes);
  const auto frames = readAll(file);
  ASSERT_EQ(frames.size(), std::size(kSensors));
  for (const auto& frame : frames)
    EXPECT_EQ(frame.objects->objects.at(0).label, frame.scan->sensorLabel);
}

TEST(SeveralSensors, OneThatWritesLateStillGetsItsPoses)
{
  const TemporaryFolder folder;
  Objects records;
  std::vector<mrpt::serialization::CSerializable::Ptr> late;
  for (int i = 0; i < 100; ++i)
  {
    const double time = kStart + 0.1 * i;
    records.push_back(samplePose(time, CPose3D(0.1 * i, 0, 0, 0, 0, 0)));
    records.push_back(sampleScan(time, "front"));
    late.push_back(sampleScan(time, "rear"));
    if (i >= 20) records.push_back(late[static_cast<std::size_t>(i - 20)]);  // by two seconds
  }
  for (const auto& frame : readAll(writeObjects(folder.path("x.rawlog"), records)))
  {
    ASSERT_TRUE(frame.T_odom_robot) << frame.scan->sensorLabel << " " << frame.time();
    EXPECT_NEAR(frame.T_odom_robot->x(), frame.time() - kStart, 1e-6);
  }
}

TEST(SeveralSensors, OneMayDieAndOneMayHaveNoBoxes)
{
  const TemporaryFolder folder;
  Objects records;
  for (int i = 0; i < 60; ++i)
  {
    const double time = kStart + 0.05 * i;
    records.push_back(samplePose(time, CPose3D(0.05 * i, 0, 0, 0, 0, 0)));
    for (const auto* sensor : {"dies", "no boxes", "lives"})
    {
      if (sensor == std::string("dies") && i >= 30) continue;
      records.push_back(sampleScan(time, sensor));
      if (sensor != std::string("no boxes")) records.push_back(sampleBoxes(time, sensor));
    }
  }
  std::map<std::string, unsigned> frames, withBoxes, withPose;
  for (const auto& frame : readAll(writeObjects(folder.path("x.rawlog"), records)))
  {
    ++frames[frame.scan->sensorLabel];
    withBoxes[frame.scan->sensorLabel] += frame.objects ? 1 : 0;
    withPose[frame.scan->sensorLabel] += frame.T_odom_robot ? 1 : 0;
  }
  const std::map<std::string, unsigned> all = {
      {    "dies", 30},
      {   "lives", 60},
      {"no boxes", 60}
  };
  EXPECT_EQ(frames, all);
  EXPECT_EQ(withPose, all);
  EXPECT_EQ(withBoxes["dies"], 30u);
  EXPECT_EQ(withBoxes["lives"], 60u);
  EXPECT_EQ(withBoxes["no boxes"], 0u);
}

TEST(PixelLabelSource, LabelsBecomeBoxes)
{
  const TemporaryFolder folder;
  const auto file =
      writeObjects(folder.path("x.rawlog"), {labelledScan(kStart, "a"), sampleScan(kStart, "b")});
  RawlogSource source(file, withPixelLabels());
  std::vector<std::string> warnings;
  source.logging_enable_console_output = false;
  source.logRegisterCallback([&](std::string_view text, auto, std::string_view, auto)
                             { warnings.emplace_back(text); });
  const auto frames = readAll(source);
  ASSERT_EQ(frames.size(), 2u);
  ASSERT_TRUE(frames[0].objects);
  EXPECT_TRUE(frames[0].objectsFromPixelLabels);
  ASSERT_EQ(frames[0].objects->objects.size(), 1u);
  EXPECT_EQ(frames[0].objects->objects[0].label, "chair_1");
  EXPECT_EQ(frames[0].objects->objects[0].box.y2, 19);
  EXPECT_FALSE(frames[1].objects) << "nobody looked";
  EXPECT_TRUE(source.hasBoxes());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(
      warnings[0], file + ": pixel labels that are not in the label table are no objects: floor");
  EXPECT_FALSE(readAll(file)[0].objects) << "only when asked for";
}

TEST(PixelLabelSource, BoxesGoBeforeLabels)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"), {labelledScan(kStart, "a"), labelledScan(kStart, "b"),
                                labelledScan(kStart + 1, "a"), sampleBoxes(kStart + 1, "a")});
  const auto labelsOf = [&]
  {
    std::string labels;
    for (const auto& frame : readAll(file, withPixelLabels()))
      labels +=
          (frame.objectsFromPixelLabels ? "*" : "") + frame.objects->objects.at(0).label + " ";
    return labels;
  };
  EXPECT_EQ(labelsOf(), "*chair_1 *chair_1 chair ") << "embedded boxes";
  writeObjects(folder.path("x.objects.rawlog"), {sampleBoxes(kStart, "b")});
  EXPECT_EQ(labelsOf(), "*chair_1 chair *chair_1 ") << "a sidecar rules out embedded boxes";
  writeObjects(folder.path("x.objects.rawlog"), {});
  EXPECT_EQ(labelsOf(), "*chair_1 *chair_1 chair ") << "an empty one does not";
}

TEST(PixelLabelSource, TinyAndMisshapenLabels)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), {labelledScan(kStart, "a")});
  auto options = withPixelLabels();
  options.minLabelPixels = 201;  // the chair has 200
  EXPECT_TRUE(readAll(file, options).at(0).objects->objects.empty());
  auto scan = labelledScan(kStart, "a");
  scan->pixelLabels->setSize(kRows, kRows);
  writeObjects(file, {scan});
  EXPECT_EQ(
      errorOf([&] { readAll(file, options); }),
      file + ": record 0 (a): its 48x48 pixel labels do not fit its 64x48 depth image");
  options.keepGoing = true;
  EXPECT_EQ(readAll(file, options).size(), 1u);
}

TEST(PixelLabelSource, WarnsOfImagesWithTooManyObjects)
{
  const TemporaryFolder folder;
  auto scan = labelledScan(kStart, "a");
  scan->pixelLabels->setSize(kRows, kColumns);
  scan->pixelLabels->setLabelName(3, "chair");
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) scan->pixelLabels->unsetAll(row, column, 0);
  for (int row = 0; row < 48; ++row)  // 16 x 21 squares of two pixels
    for (int column = 0; column < 63; ++column)
      if (row % 3 != 2 && column % 3 != 2) scan->pixelLabels->setLabel(row, column, 3);
  auto next = mrpt::obs::CObservation3DRangeScan::Create(*scan);
  next->timestamp += std::chrono::seconds(1);
  const auto file = writeObjects(folder.path("x.rawlog"), {scan, next});
  RawlogSource source(file, withPixelLabels());
  std::vector<std::string> warnings;
  source.sendWarningsTo([&](const std::string& text) { warnings.push_back(text); });
  for (const auto& frame : readAll(source)) EXPECT_EQ(frame.objects->objects.size(), 300u);
  ASSERT_EQ(warnings.size(), 1u) << "for both images";
  EXPECT_EQ(
      warnings[0], file +
                       " (a): the pixel labels of an image have more than 300 separate parts, of "
                       "which the largest are kept (minLabelPixels leaves out small ones)");
}

TEST(RgbdScan, TheMemoryOfItsImagesIsKnown)
{
  auto scan = sampleScan(kStart);
  constexpr std::size_t kPixels = std::size_t{kRows} * kColumns;
  EXPECT_EQ(imageBytesOf(*scan), kPixels * (2 + 3)) << "depth and colour";
  auto labels = std::make_shared<mrpt::obs::TPixelLabelInfo<8>>();
  labels->setSize(kRows, kColumns);
  scan->pixelLabels = labels;
  scan->rangeImageOtherLayers["second"] = scan->rangeImage;
  EXPECT_EQ(imageBytesOf(*scan), kPixels * (2 + 3 + 8 + 2));
  scan->intensityImage.setExternalStorage("x.jpg");
  EXPECT_EQ(imageBytesOf(*scan), kPixels * (2 + 8 + 2)) << "not in memory";
}
