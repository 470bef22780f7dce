#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/TPixelLabelInfo.h>

#include <filesystem>

#include "../obs/TemporaryFolder.h"
#include "../sensors/SampleRawlog.h"
#include "Fuzz.h"
#include "quadmap/base/ShareFiles.h"
#include "quadmap/sensors/RawlogSource.h"
#include "quadmap/simulator/Scene.h"

using namespace quadmap;

namespace
{
/** Reads a rawlog to its end. */
void readToEnd(const std::string& rawlog, bool keepGoing)
{
  RawlogSourceOptions options;
  options.keepGoing = keepGoing;
  RawlogSource source(rawlog, options);
  source.setMinLoggingLevel(mrpt::system::LVL_ERROR);
  while (source.next())
  {
  }
}
}  // namespace

TEST(Fuzz, SceneFile)
{
  const TemporaryFolder folder;
  FuzzRun run;
  run.words = {"[object x]", "[material a]", "size =",  "box",
               "cylinder",   "${",           "@define", "part9 ="};
  fuzz(
      readFile(findShareFile("scenes/home.ini")), run,
      [&](const std::string& text)
      {
        const auto scene = simulator::readScene(folder.write("scene.ini", text));
        for (const auto& object : scene.objects) object.truth();
      });
}

TEST(Fuzz, RawlogWithDamagedBoxes)
{
  const TemporaryFolder folder;
  const auto rawlog = writeObjects(
      folder.path("a.rawlog"), {samplePose(1000, {}), sampleScan(1000), samplePose(1001, {})});
  writeObjects(
      folder.path("a.objects.rawlog"), {sampleBoxes(1000), sampleBoxes(1000.5)},
      /*compressed*/ false);
  const auto valid = readFile(folder.path("a.objects.rawlog"));
  for (const bool keepGoing : {false, true})
  {
    FuzzRun run;
    run.mostlyHarmless = keepGoing;
    fuzz(
        valid, run,
        [&](const std::string& bytes)
        {
          folder.write("a.objects.rawlog", bytes);
          readToEnd(rawlog, keepGoing);
        });
  }
}

TEST(Fuzz, RawlogWithDamagedStockRecords)
{
  const TemporaryFolder folder;
  const auto path = folder.path("a.rawlog");
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->timestamp = stamp(1000.5);
  writeObjects(path, {samplePose(1000, {}), odometry, samplePose(1001, {})}, false);
  const auto valid = readFile(path);
  for (const bool keepGoing : {false, true})
  {
    FuzzRun run;
    run.mostlyHarmless = keepGoing;
    fuzz(
        valid, run,
        [&](const std::string& bytes)
        {
          folder.write("a.rawlog", bytes);
          readToEnd(path, keepGoing);
        });
  }
}

namespace
{
/** Damages uncompressed rawlogs of these records. */
void fuzzRecords(
    const std::vector<mrpt::serialization::CSerializable::Ptr>& records,
    const std::vector<std::string>& words = {})
{
  const TemporaryFolder folder;
  const auto path = writeObjects(folder.path("a.rawlog"), records, false);
  FuzzRun run;
  run.words = words;
  run.mostlyHarmless = true;  // most bytes are pixels
  fuzz(
      readFile(path), run,
      [&](const std::string& bytes)
      {
        folder.write("a.rawlog", bytes);
        readToEnd(path, false);
      });
}

/** A scan of few pixels, so that most damages hit something else. */
mrpt::obs::CObservation3DRangeScan::Ptr tinyScan()
{
  auto scan = sampleScan(1000);
  scan->rangeImage_setSize(3, 4);
  scan->cameraParams.ncols = 4;
  scan->cameraParams.nrows = 3;
  scan->intensityImage = mrpt::img::CImage(4, 3, mrpt::img::CH_RGB);
  return scan;
}
}  // namespace

TEST(Fuzz, RangeScan) { fuzzRecords({tinyScan()}); }

TEST(Fuzz, RangeScanWithPixelLabels)
{
  auto scan = tinyScan();
  scan->pixelLabels = std::make_shared<mrpt::obs::TPixelLabelInfo<2>>();
  scan->pixelLabels->setSize(3, 4);
  scan->pixelLabels->setLabelName(1, "chair_2");
  scan->pixelLabels->setLabel(1, 1, 1);
  fuzzRecords({scan});
}

TEST(Fuzz, EmbeddedJpeg)
{
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
  fuzzRecords({tinyScan()}, {"\xff\xc0", "\xff\xc4", "\xff\xda", "\xff\xd9", "\xff\xc2"});
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);
}

TEST(Fuzz, ExternalImages)
{
  auto scan = tinyScan();
  scan->intensityImage.setExternalStorage("a/picture.jpg");
  const TemporaryFolder folder;
  const auto path = writeObjects(folder.path("a.rawlog"), {scan}, false);
  std::filesystem::create_directory(folder.path("a"));
  ASSERT_TRUE(sampleScan(1000)->intensityImage.saveToFile(folder.path("a/picture.jpg")));
  FuzzRun run;
  run.words = {"../", "/", "/etc/passwd", "..", "//"};
  fuzz(
      readFile(path), run,
      [&](const std::string& bytes)
      {
        folder.write("a.rawlog", bytes);
        readToEnd(path, false);
      });
}

TEST(Fuzz, FramesAndActions)
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(samplePose(1000, {}));
  frame->insert(sampleBoxes(1000));
  frame->insert(sampleScan(1000));
  mrpt::obs::CActionRobotMovement2D flat;
  flat.computeFromOdometry({0.1, 0, 0}, {});
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(flat);
  actions->insert(mrpt::obs::CActionRobotMovement3D());
  fuzzRecords(
      {actions, frame}, {"CSensoryFrame",
                         "\x8d"
                         "CSensoryFrame\x02"});
}

TEST(Fuzz, TruncatedRangeScan)
{
  const TemporaryFolder folder;
  const auto path = folder.path("a.rawlog");
  writeObjects(path, {sampleScan(1000)}, false);
  const auto valid = readFile(path);
  constexpr std::size_t kStep = 7;
  for (std::size_t size = 1; size < valid.size(); size += kStep)
  {
    folder.write("a.rawlog", valid.substr(0, size));
    ASSERT_NE(errorOf([&] { readToEnd(path, false); }), "") << size << " bytes";
  }
}

TEST(Fuzz, CompressedRawlog)
{
  const TemporaryFolder folder;
  const auto path = folder.path("a.rawlog");
  writeObjects(path, {samplePose(1000, {}), sampleBoxes(1000.5), samplePose(1001, {})});
  const auto valid = readFile(path);
  fuzz(
      valid, FuzzRun(),
      [&](const std::string& bytes)
      {
        folder.write("a.rawlog", bytes);
        readToEnd(path, false);
      });
}
