#include "quadmap/slam/RawlogRun.h"

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CSimpleMap.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "../../sensors/SampleRawlog.h"
#include "../../sensors/StopAfter.h"
#include "../SyntheticRoom.h"
#include "quadmap/geometry/Overlap.h"
#include "quadmap/obs/Trajectory.h"

using namespace quadmap;
using nlohmann::json;

namespace
{
const char* const kFiles[] = {"objects.quadmap",         "objects.json",  "trajectory.tum",
                              "trajectory_odometry.tum", "map.simplemap", "objects.simplemap",
                              "pose-graph.graph",        "report.json"};

class RawlogRun : public ::testing::Test
{
 protected:
  RawlogRunRequest requestFor(const std::string& rawlog, const std::string& out = "out") const
  {
    RawlogRunRequest request;
    request.rawlog = rawlog;
    request.outputDirectory = folder_.path(out);
    request.configuration.keyframes.every = 1;
    return request;
  }
  std::string recording(const SyntheticRecording& r = {}, const SyntheticRoom& room = {}) const
  {
    return writeRecording(folder_.path("x.rawlog"), r, room);
  }
  std::string output(const std::string& name, const std::string& out = "out") const
  {
    return folder_.path(out + "/" + name);
  }
  json report(const std::string& out = "out") const
  {
    return json::parse(readFile(output("report.json", out)));
  }
  /** Expects that the run fails with a line that has the text, and leaves no output. */
  void expectFailure(const RawlogRunRequest& request, const std::string& text) const
  {
    const std::string error = errorOf([&] { runOnRawlog(request); });
    EXPECT_NE(error.find(text), std::string::npos) << "'" << text << "' is not in: " << error;
    EXPECT_EQ(error.find(request.rawlog), 0u) << error;
    EXPECT_FALSE(std::filesystem::exists(request.outputDirectory));
  }

  TemporaryFolder folder_;
};
}  // namespace

TEST_F(RawlogRun, MapsTheBoxAndWritesEveryFile)
{
  const SyntheticRoom room;
  const auto summary = runOnRawlog(requestFor(recording()));
  EXPECT_FALSE(summary.interrupted);
  EXPECT_EQ(summary.files.size(), std::size(kFiles));
  for (const auto* name : kFiles) EXPECT_TRUE(std::filesystem::exists(output(name))) << name;
  EXPECT_EQ(
      std::distance(std::filesystem::directory_iterator(folder_.path("out")), {}),
      static_cast<std::ptrdiff_t>(std::size(kFiles)))
      << "no temporary file is left";

  const auto objects = readObjectsJson(output("objects.json"));
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].label, room.label);
  EXPECT_EQ(objects[0].observations, 6u);
  // Exact depths in millimetres and exact boxes: what is left is the pixel grid (8 mm at 2 m)
  EXPECT_LT((objects[0].object.center() - room.box.center()).norm(), 0.02);
  EXPECT_GT(cuboidIoU(objects[0].object, room.box), 0.88);

  const auto trajectory = readTumTrajectory(output("trajectory.tum"));
  ASSERT_EQ(trajectory.size(), 6u);
  EXPECT_NEAR(trajectory[3].time, kStart + 0.6, 1e-6);
  // The odometry was exact, and the pixel grid no reason to doubt what it claims for a step.
  EXPECT_LT((trajectory[3].pose - room.robotAt(0.75)).norm(), 0.005);
  const auto odometry = readTumTrajectory(output("trajectory_odometry.tum"));
  EXPECT_LT((odometry[3].pose - room.robotAt(0.75)).norm(), 1e-6);
}

TEST_F(RawlogRun, QuadricLooksAtNoDepth)
{
  const SyntheticRoom room;
  auto records = recordsOf(room, {12});
  const auto writeAndRun = [&](const std::string& name)
  {
    auto request = requestFor(writeObjects(folder_.path(name + ".rawlog"), records), name);
    request.configuration.slam.method = SlamMethod::Quadric;
    runOnRawlog(request);
    return readFile(output("objects.json", name)) + readFile(output("trajectory.tum", name));
  };
  const std::string withDepth = writeAndRun("with");
  const auto objects = readObjectsJson(output("objects.json", "with"));
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].label, room.label);
  EXPECT_LT((objects[0].object.center() - room.box.center()).norm(), 0.1) << "[m]";
  for (auto& record : records)
    if (auto* scan = dynamic_cast<mrpt::obs::CObservation3DRangeScan*>(record.get()))
      scan->rangeImage.fill(0);
  EXPECT_EQ(writeAndRun("without"), withDepth);
}

TEST_F(RawlogRun, MapFilesHoldTheSameObjects)
{
  const auto summary = runOnRawlog(requestFor(recording()));
  CQuadricObjectMap loaded;
  mrpt::io::CFileGZInputStream file(output("objects.quadmap"));
  mrpt::serialization::archiveFrom(file) >> loaded;
  mrpt::maps::CSimpleMap simple;
  ASSERT_TRUE(simple.loadFromFile(output("objects.simplemap")));
  ASSERT_EQ(simple.size(), 6u);
  for (std::size_t k = 0; k < simple.size(); ++k)
  {
    const auto [pose, frame] = simple.get(k);
    mrpt::math::CMatrixDouble66 covariance;
    mrpt::poses::CPose3D mean;
    pose->getCovarianceAndMean(covariance, mean);
    ASSERT_TRUE(summary.result.keyframes[k].covariance);
    EXPECT_EQ(covariance, *summary.result.keyframes[k].covariance) << "that of the estimation";
  }
  CQuadricObjectMap rebuilt;
  rebuilt.loadFromSimpleMap(simple);
  rebuilt.consolidate();
  rebuilt.conclude();
  for (const auto* map : {&loaded, &rebuilt})
  {
    ASSERT_EQ(map->confirmedObjects().size(), 1u);
    const auto& a = map->confirmedObjects()[0]->object;
    const auto& b = summary.result.map.confirmedObjects().at(0)->object;
    EXPECT_LT((a.center() - b.center()).norm(), 1e-6);
    EXPECT_LT((a.semiAxes() - b.semiAxes()).norm(), 1e-6);
  }
}

TEST_F(RawlogRun, NamesUnknownLabelsInOneLine)
{
  auto records = recordsOf(SyntheticRoom(), {8});
  int number = 0;
  for (auto& record : records)
    if (auto* boxes = dynamic_cast<CObservationObjects*>(record.get()))
      for (auto& object : boxes->objects) object.label = "thing " + std::to_string(++number);
  ASSERT_EQ(number, 8);
  const auto request = requestFor(writeObjects(folder_.path("x.rawlog"), records));
  const auto warnings = runOnRawlog(request).result.warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(
      warnings[0], request.rawlog +
                       ": labels that are not in the label table: thing 1, thing 2, thing 3, thing "
                       "4, thing 5 and 3 more; neutral properties are used");
  for (std::size_t i = 1; i < warnings.size(); ++i)
    EXPECT_EQ(warnings[i].find("thing"), std::string::npos) << warnings[i];
}

TEST_F(RawlogRun, ReportSaysWhatHappened)
{
  SyntheticRoom room;
  room.label = "strange thing";
  auto request = requestFor(recording({}, room));
  request.version = "1.2.3";
  std::map<mrpt::system::VerbosityLevel, unsigned> messages;
  unsigned keyframes = 0;
  request.onMessage = [&](auto level, const std::string& text)
  {
    ++messages[level];
    if (text.rfind("keyframe ", 0) == 0) ++keyframes;
  };
  runOnRawlog(request);
  EXPECT_EQ(keyframes, 6u) << "one for each keyframe";
  EXPECT_EQ(messages[mrpt::system::LVL_WARN], 1u);
  const json r = report();
  EXPECT_EQ(r["program_version"], "1.2.3");
  EXPECT_EQ(r["input"]["frames"], 6);
  EXPECT_EQ(r["input"]["keyframes"], 6);
  EXPECT_EQ(r["input"]["records"], 18);
  EXPECT_EQ(r["input"]["odometry"], "CObservationRobotPose odometry");
  EXPECT_EQ(r["input"]["interrupted"], false);
  EXPECT_EQ(r["configuration"]["keyframes"]["every"], 1) << "numbers are numbers";
  EXPECT_EQ(r["configuration"]["joint"]["correctPoses"], true);
  EXPECT_EQ(r["configuration"]["slam"]["method"], "rgbd");
  EXPECT_EQ(r["boxes"]["total"], 6);
  const json& counts = r["boxes"]["by_label"]["strange thing"];
  EXPECT_EQ(
      counts["complete"].get<int>() + counts["partial"].get<int>() + counts["rejected"].get<int>(),
      6);
  ASSERT_EQ(r["warnings"].size(), 1u) << "one for the unknown label, however often it is seen";
  EXPECT_NE(r["warnings"][0].get<std::string>().find("strange thing"), std::string::npos);
  EXPECT_TRUE(r["dropped"].empty());
  EXPECT_GT(r["timing"]["peak_memory_mb"], 1.0);
  EXPECT_EQ(r["timing"]["modules"]["perception"]["calls"], 6);
  ASSERT_EQ(r["associations"].size(), 6u);
  const json& box = r["associations"][5]["boxes"][0];
  EXPECT_EQ(r["associations"][5]["record"], 16);
  EXPECT_TRUE(box["object"].is_number()) << box;
  EXPECT_LE(box["log_posterior"], 0.0);
}

TEST_F(RawlogRun, SameInputGivesTheSameBytes)
{
  const auto rawlog = recording();
  runOnRawlog(requestFor(rawlog, "a"));
  runOnRawlog(requestFor(rawlog, "b"));
  for (const auto* name : kFiles)
  {
    if (name == std::string("report.json")) continue;  // has times
    EXPECT_TRUE(readFile(output(name, "a")) == readFile(output(name, "b"))) << name;
  }
  json a = report("a"), b = report("b");
  a.erase("timing");
  b.erase("timing");
  EXPECT_EQ(a, b);
}

TEST_F(RawlogRun, InterruptedRunLeavesValidFilesOfWhatWasDone)
{
  auto request = requestFor(recording());
  stopAfter(request, 4);
  const auto summary = runOnRawlog(request);
  EXPECT_TRUE(summary.interrupted);
  EXPECT_EQ(report()["input"]["interrupted"], true);
  EXPECT_EQ(readTumTrajectory(output("trajectory.tum")).size(), 4u);
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(output("map.simplemap")));
  EXPECT_EQ(map.size(), 4u);
}

TEST_F(RawlogRun, IsInterruptedBetweenImagesAsWell)
{
  for (int record = 1; record <= 6; ++record)
  {
    auto request = requestFor(recording());
    stopOnceAfter(request, 4, record);
    EXPECT_TRUE(runOnRawlog(request).interrupted) << record;
    std::filesystem::remove_all(request.outputDirectory);
  }
}

TEST_F(RawlogRun, IsInterruptedByOneWordBeforeTheFirstImage)
{
  for (int n = 1; n <= 30; ++n)  // of the questions, all but the last ones before the first image
  {
    auto request = requestFor(recording());
    int asked = 0;
    request.shouldStop = [&] { return ++asked == n; };
    try
    {
      EXPECT_TRUE(runOnRawlog(request).interrupted) << n;
    }
    catch (const std::runtime_error& e)
    {
      EXPECT_NE(std::string(e.what()).find("interrupted before the first"), std::string::npos) << n;
    }
    std::filesystem::remove_all(request.outputDirectory);
  }
}

TEST_F(RawlogRun, IsInterruptedWhereNoImagesAre)
{
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (int i = 0; i < 100; ++i) records.push_back(samplePose(kStart + 0.1 * i, {}));
  records.push_back(sampleScan(kStart + 5));
  auto request = requestFor(writeObjects(folder_.path("x.rawlog"), records));
  int asked = 0;
  request.shouldStop = [&] { return ++asked > 10; };
  expectFailure(request, "interrupted before the first image");
  EXPECT_LT(asked, 20);
}

// What the run asks last is whether to look for doubles on.
TEST_F(RawlogRun, IsInterruptedBehindTheLastImageAsWell)
{
  auto request = requestFor(recording());
  int asked = 0, last = 0;
  request.shouldStop = [&] { return ++asked == last; };
  EXPECT_FALSE(runOnRawlog(request).interrupted);
  std::filesystem::remove_all(request.outputDirectory);
  last = std::exchange(asked, 0);
  const auto summary = runOnRawlog(request);
  EXPECT_TRUE(summary.interrupted);
  EXPECT_TRUE(summary.result.loops.stopped);
  EXPECT_NE(readFile(output("report.json")).find("stopped before it was known"), std::string::npos);
  EXPECT_EQ(readTumTrajectory(output("trajectory.tum")).size(), 6u);
}

TEST_F(RawlogRun, ProgressGrowsToOne)
{
  auto request = requestFor(recording());
  std::vector<double> shares;
  request.onProgress = [&](const RunProgress& p) { shares.push_back(p.share); };
  runOnRawlog(request);
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_NEAR(shares.back(), 1.0, 1e-6);
}

TEST_F(RawlogRun, OdometryMethodNeedsNoBoxes)
{
  SyntheticRecording r;
  r.boxes = false;
  auto request = requestFor(recording(r));
  request.configuration.slam.method = SlamMethod::Odometry;
  EXPECT_TRUE(runOnRawlog(request).result.map.isEmpty());
  EXPECT_EQ(readTumTrajectory(output("trajectory.tum")).size(), 6u);
  EXPECT_TRUE(readObjectsJson(output("objects.json")).empty());
}

TEST_F(RawlogRun, GroundTruthPosesWhenAsked)
{
  SyntheticRecording r;
  r.odometry = false;
  r.groundTruth = true;
  auto request = requestFor(recording(r));
  request.configuration.slam.odometry = PoseSource::Rawlog;
  expectFailure(request, "no odometry for any image, but ground truth poses");
  request.configuration.slam.odometry = PoseSource::GroundTruth;
  EXPECT_EQ(runOnRawlog(request).result.map.confirmedObjects().size(), 1u);
}

TEST_F(RawlogRun, PosesThatAreNotThereAreAnError)
{
  SyntheticRecording r;
  r.odometry = false;
  auto request = requestFor(recording(r));
  request.configuration.slam.odometry = PoseSource::Rawlog;
  expectFailure(request, "no odometry for any image: use --odometry visual");
  request.configuration.slam.odometry = PoseSource::GroundTruth;
  expectFailure(request, "no ground truth poses for any image");
}

TEST_F(RawlogRun, SingleImageNeedsNoPose)
{
  SyntheticRecording r;
  r.odometry = false;
  r.frames = 1;
  auto request = requestFor(recording(r));
  const auto summary = runOnRawlog(request);
  EXPECT_EQ(readTumTrajectory(output("trajectory.tum")).at(0).pose.norm(), 0);
  ASSERT_EQ(summary.result.warnings.size(), 1u);
  EXPECT_NE(summary.result.warnings[0].find("a single image"), std::string::npos);
  request.configuration.slam.odometry = PoseSource::Rawlog;
  request.outputDirectory = folder_.path("strict");
  expectFailure(request, "no odometry");
}

TEST_F(RawlogRun, SingleImageWithNothingToSeeNeedsNoPoseEither)
{
  SyntheticRecording r;
  r.odometry = false;
  r.frames = 1;
  auto records = recordsOf({}, r);
  auto& scan = dynamic_cast<mrpt::obs::CObservation3DRangeScan&>(*records.at(0));
  scan.rangeImage.setZero();
  const auto summary = runOnRawlog(requestFor(writeObjects(folder_.path("blank.rawlog"), records)));
  ASSERT_FALSE(summary.result.warnings.empty());
  EXPECT_EQ(summary.result.keyframes.size(), 1u);
}

TEST_F(RawlogRun, VisualOdometryThatSeesNothingPointsToTheRawlogsOdometry)
{
  auto records = recordsOf({}, {});
  for (auto& record : records)
    if (auto* scan = dynamic_cast<mrpt::obs::CObservation3DRangeScan*>(record.get()))
      scan->rangeImage.setZero();
  auto request = requestFor(writeObjects(folder_.path("dark.rawlog"), records));
  request.configuration.slam.odometry = PoseSource::Visual;
  expectFailure(
      request,
      "visual odometry finds too little texture or depth in the images: use --odometry rawlog");
}

TEST_F(RawlogRun, NoBoxesIsAnErrorUnlessToldToGoOn)
{
  SyntheticRecording r;
  r.boxes = false;
  auto request = requestFor(recording(r));
  expectFailure(request, "no object boxes, neither in it nor beside it");
  request.objectsFile = folder_.write("empty.rawlog", "");
  expectFailure(request, "no object boxes, neither in it nor in " + request.objectsFile);
  request.objectsFile.clear();
  request.keepGoing = true;
  const auto summary = runOnRawlog(request);
  EXPECT_TRUE(summary.result.map.isEmpty());
  ASSERT_EQ(summary.result.warnings.size(), 1u);
  EXPECT_EQ(readTumTrajectory(output("trajectory.tum")).size(), 6u);
}

TEST_F(RawlogRun, NoImagesIsAnErrorThatListsWhatThereIs)
{
  const auto rawlog =
      writeObjects(folder_.path("x.rawlog"), {samplePose(kStart, {}), samplePose(kStart + 1, {})});
  expectFailure(requestFor(rawlog), "no usable RGB-D images; it has 2 CObservationRobotPose");
  auto keepGoing = requestFor(writeObjects(
      folder_.path("back.rawlog"), {samplePose(kStart + 1, {}), samplePose(kStart, {})}));
  keepGoing.keepGoing = true;
  expectFailure(keepGoing, "left out: 1, the first being " + keepGoing.rawlog + ": record 1 (");
  auto request = requestFor(recording());
  request.sensorLabel = "rear";
  expectFailure(request, "no usable RGB-D images of a sensor \"rear\"");
}

TEST_F(RawlogRun, UnusableCalibrationIsAnErrorOrDropped)
{
  auto records = recordsOf({}, {});
  auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(records[7]);
  ASSERT_TRUE(scan);
  scan->cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  auto request = requestFor(writeObjects(folder_.path("x.rawlog"), records));
  expectFailure(request, "record 7 (camera): ");
  request.keepGoing = true;
  const auto summary = runOnRawlog(request);
  ASSERT_FALSE(summary.dropped.empty());
  EXPECT_NE(summary.dropped[0].find("record 7 (camera): "), std::string::npos);
  EXPECT_EQ(report()["dropped"][0]["record"], 7);
  EXPECT_EQ(summary.result.keyframes.size(), 5u);
}

TEST_F(RawlogRun, WhateverAFrameThrowsItIsNamed)
{
  using Scan = mrpt::obs::CObservation3DRangeScan;
  const std::function<void(Scan&)> poisons[] = {
      [](Scan& s) { s.sensorPose.x(1e308); },  // std::invalid_argument, as sums are infinite
      [](Scan& s) { s.rangeUnits = 3e38f; },
      [](Scan& s) { s.cameraParams.setIntrinsicParamsFromValues(1e-300, 1e-300, 160, 120); },
      [](Scan& s) { s.cameraParams.setIntrinsicParamsFromValues(260, 260, 1e300, 120); }};
  for (std::size_t i = 0; i < std::size(poisons); ++i)
  {
    auto records = recordsOf({}, {});
    const auto scan = std::dynamic_pointer_cast<Scan>(records.at(7));
    const auto boxes = std::dynamic_pointer_cast<CObservationObjects>(records.at(8));
    poisons[i](*scan);
    boxes->sensorPose = scan->sensorPose;
    boxes->cameraParams = scan->cameraParams;
    SCOPED_TRACE(i);
    auto request =
        requestFor(writeObjects(folder_.path("x.rawlog"), records), "out" + std::to_string(i));
    expectFailure(request, "x.rawlog: record 7 (camera): ");
    request.keepGoing = true;
    const auto summary = runOnRawlog(request);
    ASSERT_FALSE(summary.dropped.empty());
    EXPECT_EQ(summary.dropped[0].find(request.rawlog + ": record 7 (camera): "), 0u);
  }
}

TEST_F(RawlogRun, ItIsClosingOnceTheResultIsComputed)
{
  int closing = 0;
  auto request = requestFor(recording());
  request.onClosing = [&] { ++closing; };
  runOnRawlog(request);
  EXPECT_EQ(closing, 1);
  auto records = recordsOf({}, {});
  const auto isPose = [](const auto& record)
  { return std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(record) != nullptr; };
  records.erase(std::remove_if(records.begin(), records.end(), isPose), records.end());
  request.rawlog = writeObjects(folder_.path("y.rawlog"), records);
  request.outputDirectory = folder_.path("y");
  request.configuration.slam.odometry = PoseSource::Rawlog;
  expectFailure(request, "no odometry for any image");
  EXPECT_EQ(closing, 1) << "the final estimate can be interrupted";
}

TEST_F(RawlogRun, FramesWithoutDepthAreCounted)
{
  auto records = recordsOf({}, {});
  for (const std::size_t i : {1u, 4u})
    std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(records[i])->rangeImage.fill(0);
  const auto summary = runOnRawlog(requestFor(writeObjects(folder_.path("x.rawlog"), records)));
  EXPECT_EQ(report()["input"]["keyframes_without_depth"], 2);
  ASSERT_EQ(summary.result.warnings.size(), 1u);
  EXPECT_EQ(
      summary.result.warnings[0],
      folder_.path("x.rawlog") + ": 2 of 6 keyframes have no valid depth at all");
}

TEST_F(RawlogRun, TruncatedFileIsAnErrorOrShortened)
{
  const auto rawlog = recording();
  std::filesystem::resize_file(rawlog, std::filesystem::file_size(rawlog) * 2 / 3);
  auto request = requestFor(rawlog);
  expectFailure(request, "record ");
  request.keepGoing = true;
  const auto summary = runOnRawlog(request);
  EXPECT_EQ(summary.dropped.size(), 1u);
  EXPECT_GE(summary.result.keyframes.size(), 2u);
  EXPECT_LT(summary.result.keyframes.size(), 6u);
}

TEST_F(RawlogRun, TwoSensorsAreKeyframedEachForItself)
{
  const SyntheticRoom room;
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (int i = 0; i < 4; ++i)
  {
    const auto pose = room.robotAt(0.25 * i);
    records.push_back(samplePose(kStart + i, pose));
    for (const auto* label : {"front", "rear"})
    {
      const auto scan = room.scanFrom(pose, kStart + i);
      scan->sensorLabel = label;
      records.push_back(scan);
      records.push_back(room.boxesOf(*scan, pose));
    }
  }
  auto request = requestFor(writeObjects(folder_.path("x.rawlog"), records));
  request.configuration.keyframes.every = 2;
  const auto all = runOnRawlog(request);
  EXPECT_EQ(all.result.keyframes.size(), 4u);
  EXPECT_EQ(all.result.counts().frames, 8u);
  EXPECT_EQ(all.result.counts().boxes, 4u);
  request.sensorLabel = "rear";
  EXPECT_EQ(runOnRawlog(request).result.keyframes.size(), 2u);
}

TEST_F(RawlogRun, FullDiskLeavesNothing)
{
  const auto rawlog = recording();
  runOnRawlog(requestFor(rawlog));
  const rlim_t size = std::filesystem::file_size(output("map.simplemap"));
  std::filesystem::remove_all(std::filesystem::path(output("map.simplemap")).parent_path());
  for (const rlim_t limit : {rlim_t{2000}, size - 1})  // while spooling, while writing
  {
    const FileSizeLimit full(limit);
    const std::string error = errorOf([&] { runOnRawlog(requestFor(rawlog)); });
    EXPECT_NE(error.find("cannot be written"), std::string::npos) << limit << ": " << error;
    EXPECT_FALSE(std::filesystem::exists(output("map.simplemap"))) << limit;
  }
}

TEST_F(RawlogRun, FailureLeavesNoneOfTheFoldersItMade)
{
  SyntheticRecording r;
  r.boxes = false;
  std::filesystem::create_directory(folder_.path("mine"));
  expectFailure(requestFor(recording(r), "mine/a/b/c"), "no object boxes");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path("mine")));

  std::filesystem::create_symlink("nowhere", folder_.path("mine/link"));
  EXPECT_THROW(runOnRawlog(requestFor(recording(), "mine/link")), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.path("mine/link"))) << "not made by the run";
}

TEST_F(RawlogRun, OutputThatCannotBeMadeIsNamed)
{
  auto request = requestFor(recording());
  request.outputDirectory = folder_.path("x.rawlog");
  EXPECT_EQ(errorOf([&] { runOnRawlog(request); }).find(request.outputDirectory), 0u);
  request.outputDirectory = "/proc/nothing";
  EXPECT_EQ(errorOf([&] { runOnRawlog(request); }).find("/proc/nothing"), 0u);
}
