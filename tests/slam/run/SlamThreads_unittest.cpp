#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "../../sensors/StopAfter.h"
#include "../SeveralCameras.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/slam/RawlogRun.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using Records = std::vector<mrpt::serialization::CSerializable::Ptr>;

namespace
{
constexpr int kThreads[] = {1, 2, 4};

/** Compares the results of runs with different numbers of threads. */
class SlamThreads : public ::testing::Test
{
 protected:
  RawlogRunRequest requestFor(const std::string& rawlog, int threads) const
  {
    RawlogRunRequest request;
    request.rawlog = rawlog;
    request.outputDirectory = folder_.path("out" + std::to_string(threads));
    request.configuration.keyframes.every = 1;
    request.configuration.slam.threads = threads;
    return request;
  }

  /** Name and bytes of every file of a run, without the times of the report. */
  std::map<std::string, std::string> filesOf(int threads) const
  {
    std::map<std::string, std::string> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(folder_.path("out" + std::to_string(threads))))
      files[entry.path().filename().string()] = readFile(entry.path().string());
    auto report = nlohmann::json::parse(files.at("report.json"));
    report.erase("timing");
    files["report.json"] = report.dump();
    return files;
  }

  void expectTheSameFiles() const
  {
    const auto one = filesOf(1);
    EXPECT_EQ(one.size(), 8u);
    for (const int threads : kThreads)
    {
      const auto several = filesOf(threads);
      ASSERT_EQ(several.size(), one.size());
      for (const auto& [name, bytes] : one)
        EXPECT_TRUE(several.at(name) == bytes) << name << " with " << threads << " threads";
    }
  }

  /** The first images of the bundled rawlog. */
  RawlogRunRequest bundled(int threads, int frames) const
  {
    auto request = requestFor(QUADMAP_SOURCE_DIR "/rawlogs/home.rawlog", threads);
    stopAfter(request, frames);
    return request;
  }

  TemporaryFolder folder_;
};

/** Records of three cameras at each place around the cuboid, with an odometry that drifts in yaw.
 */
Records driftingCameras(int places)
{
  auto cameras = fourCameras();
  cameras.pop_back();
  Records records;
  for (int i = 0; i < places; ++i)
  {
    const double time = kStart + 0.2 * i;
    const CPose3D pose = cameras[0].robotAt(0.2 * i);
    records.push_back(samplePose(time, pose + CPose3D(0.01 * i, 0, 0, 0.01 * i, 0, 0)));
    for (const auto& camera : cameras)
    {
      const auto scan = camera.scanFrom(pose, time);
      records.push_back(scan);
      records.push_back(camera.boxesOf(*scan, pose));
    }
  }
  return records;
}

/** Gives the n-th image and its boxes a calibration that only perception refuses. */
void spoil(Records& records, std::size_t n)
{
  using mrpt::obs::CObservation3DRangeScan;
  for (std::size_t i = 0; i < records.size(); ++i)
    if (std::dynamic_pointer_cast<CObservation3DRangeScan>(records[i]) && n-- == 0)
    {
      const auto setTo = [](mrpt::img::TCamera& camera)
      { camera.setIntrinsicParamsFromValues(0.5, 0.5, 160, 120); };
      setTo(dynamic_cast<CObservation3DRangeScan&>(*records[i]).cameraParams);
      setTo(dynamic_cast<CObservationObjects&>(*records.at(i + 1)).cameraParams);
      return;
    }
}
}  // namespace

TEST_F(SlamThreads, GiveTheSameBytes)
{
  for (const int threads : kThreads)
  {
    const auto result = runOnRawlog(bundled(threads, 14)).result;
    EXPECT_EQ(result.keyframes.size(), 14u);
    EXPECT_GT(result.map.objects().size(), 2u) << "there is something to compare";
  }
  expectTheSameFiles();
}

TEST_F(SlamThreads, GiveTheSameBytesWithVisualOdometry)
{
  for (const int threads : kThreads)
  {
    auto request = bundled(threads, 8);
    request.configuration.slam.odometry = PoseSource::Visual;
    EXPECT_EQ(runOnRawlog(request).result.keyframes.size(), 8u);
  }
  expectTheSameFiles();
}

TEST_F(SlamThreads, GiveTheSameBytesWithSeveralCameras)
{
  const auto rawlog = writeObjects(folder_.path("x.rawlog"), driftingCameras(4));
  for (const int threads : kThreads)
    EXPECT_EQ(runOnRawlog(requestFor(rawlog, threads)).result.keyframes.size(), 12u);
  expectTheSameFiles();
}

TEST_F(SlamThreads, InterruptedRunLeavesWhatWasTaken)
{
  for (const int threads : kThreads)
  {
    const auto summary = runOnRawlog(bundled(threads, 3));
    EXPECT_TRUE(summary.interrupted);
    const std::string out = folder_.path("out" + std::to_string(threads));
    EXPECT_EQ(readTumTrajectory(out + "/trajectory.tum").size(), 3u);
    mrpt::maps::CSimpleMap map;
    ASSERT_TRUE(map.loadFromFile(out + "/map.simplemap"));
    EXPECT_EQ(map.size(), 3u);
  }
  expectTheSameFiles();
}

TEST_F(SlamThreads, BadFramesAreLeftOut)
{
  auto records = driftingCameras(4);
  for (const std::size_t bad : {0u, 4u, 5u, 11u}) spoil(records, bad);
  const auto rawlog = writeObjects(folder_.path("x.rawlog"), records);
  for (const int threads : kThreads)
  {
    auto request = requestFor(rawlog, threads);
    request.keepGoing = true;
    const auto summary = runOnRawlog(request);
    EXPECT_EQ(summary.dropped.size(), 4u);
    EXPECT_EQ(summary.result.keyframes.size(), 8u);
    EXPECT_FALSE(summary.result.keyframes[0].odometryStep) << "there is nothing before";
    for (std::size_t k = 1; k < 8; ++k)
    {
      const auto& from = summary.result.keyframes[k - 1];
      const auto& to = summary.result.keyframes[k];
      ASSERT_TRUE(to.odometryStep);
      const CPose3D step = to.T_odom_robot - from.T_odom_robot;
      EXPECT_LT((to.odometryStep->mean - step).norm(), 1e-9) << "also over what is left out";
    }
  }
  expectTheSameFiles();
}

TEST_F(SlamThreads, TheFirstErrorIsTold)
{
  auto records = driftingCameras(14);
  for (const std::size_t bad : {5u, 7u}) spoil(records, bad);
  const auto rawlog = writeObjects(folder_.path("x.rawlog"), records);
  const auto truncated = folder_.path("truncated.rawlog");
  std::filesystem::copy_file(rawlog, truncated);
  // Cut long after the bad frames, but so that reading is ahead of perception there.
  std::filesystem::resize_file(truncated, std::filesystem::file_size(rawlog) * 22 / 24);
  std::set<std::string> errors, errorsOfTruncated;
  for (const int threads : kThreads)
  {
    errors.insert(errorOf([&] { runOnRawlog(requestFor(rawlog, threads)); }));
    errorsOfTruncated.insert(errorOf([&] { runOnRawlog(requestFor(truncated, threads)); }));
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out" + std::to_string(threads))));
  }
  const std::string why =
      ": record 12 (RGBD_3): the scan of sensor \"RGBD_3\" has no usable calibration (fx 0.5 fy "
      "0.5 "
      "cx 160 cy 120, image of 224x168)";
  // A pose and three cameras, boxes in between: image 5 is the last one of the second place.
  EXPECT_EQ(errors, std::set<std::string>{rawlog + why});
  EXPECT_EQ(errorsOfTruncated, std::set<std::string>{truncated + why});
}

TEST_F(SlamThreads, MessagesComeFromTheCallersThread)
{
  const auto caller = std::this_thread::get_id();
  const auto rawlog = writeObjects(folder_.path("x.rawlog"), driftingCameras(3));
  auto request = requestFor(rawlog, 4);
  std::vector<std::string> keyframes;
  request.onMessage = [&](auto, const std::string& text)
  {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    if (text.rfind("keyframe ", 0) == 0) keyframes.push_back(text);
  };
  runOnRawlog(request);
  ASSERT_EQ(keyframes.size(), 9u);
  for (std::size_t k = 0; k < 9; ++k)
    EXPECT_EQ(keyframes[k].find("keyframe " + std::to_string(k) + ": "), 0u) << keyframes[k];
}
