#include "../SeveralCameras.h"

#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "quadmap/geometry/Overlap.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/slam/RawlogRun.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
constexpr int kMoments = 6;
constexpr double kLag = 0.015;  // from one sensor to the next [s]

using Records = std::vector<mrpt::serialization::CSerializable::Ptr>;

/** Records of a robot that stops at places around the cuboid and takes images with all cameras, one
 * after the other. The last camera, which does not see the cuboid, has no detector. */
Records stopAndLook(const std::vector<SyntheticRoom>& cameras)
{
  Records records;
  for (int i = 0; i < kMoments; ++i)
  {
    const double time = kStart + 0.4 * i;
    const CPose3D pose = cameras[0].robotAt(0.25 * i);
    records.push_back(samplePose(time, pose));
    for (std::size_t c = 0; c < cameras.size(); ++c)
    {
      const auto scan = cameras[c].scanFrom(pose, time + kLag * static_cast<double>(c));
      records.push_back(scan);
      if (c + 1 < cameras.size()) records.push_back(cameras[c].boxesOf(*scan, pose));
    }
    records.push_back(samplePose(time + 0.1, pose));
  }
  return records;
}

/** Records of a robot that drives past the cuboid at 0.3 m/s. */
Records drivePast(const std::vector<SyntheticRoom>& cameras)
{
  constexpr double kSpeed = 0.3;  // [m/s]
  const auto poseAt = [&](double time)
  { return CPose3D(0, kSpeed * (time - kStart) - 0.3, 0, 0, 0, 0) + cameras[0].robotAt(M_PI); };
  Records records;
  for (int i = 0; i < kMoments; ++i)
  {
    const double time = kStart + 0.4 * i;
    records.push_back(samplePose(time, poseAt(time)));
    for (std::size_t c = 0; c < cameras.size(); ++c)
    {
      const double lookTime = time + kLag * static_cast<double>(c);
      const auto scan = cameras[c].scanFrom(poseAt(lookTime), lookTime);
      records.push_back(scan);
      records.push_back(cameras[c].boxesOf(*scan, poseAt(lookTime)));
    }
  }
  records.push_back(samplePose(kStart + 3, poseAt(kStart + 3)));
  return records;
}

class SeveralCameras : public ::testing::Test
{
 protected:
  /** \param correct False leaves the poses exactly as the odometry has them. */
  RawlogRunSummary run(const Records& records, bool correct = false)
  {
    RawlogRunRequest request;
    request.configuration.joint.correctPoses = correct;
    request.rawlog = writeObjects(folder_.path("x.rawlog"), records);
    request.outputDirectory = folder_.path("out");
    request.configuration.keyframes.every = 1;
    return runOnRawlog(request);
  }
  std::string output(const std::string& name) const { return folder_.path("out/" + name); }
  mrpt::maps::CSimpleMap simpleMap(const std::string& name) const
  {
    mrpt::maps::CSimpleMap map;
    EXPECT_TRUE(map.loadFromFile(output(name)));
    return map;
  }
  nlohmann::json report() const { return nlohmann::json::parse(readFile(output("report.json"))); }

  TemporaryFolder folder_;
};

void expectTheBox(const CQuadricObjectMap& map, const Ellipsoid& truth)
{
  ASSERT_EQ(map.confirmedObjects().size(), 1u);
  const auto& object = map.confirmedObjects()[0]->object;
  // Exact depths and boxes: what is left is the pixel grid (10 mm at 2.3 m)
  EXPECT_LT((object.center() - truth.center()).norm(), 0.02);
  EXPECT_GT(cuboidIoU(object, truth), 0.88);
}
}  // namespace

TEST_F(SeveralCameras, EachAloneMapsTheBoxWhicheverWayItIsMounted)
{
  const auto cameras = fourCameras();
  for (std::size_t c = 0; c < 3; ++c)
  {
    SCOPED_TRACE(cameras[c].sensor);
    const auto summary = run(stopAndLook({cameras[c], cameras[3]}));
    EXPECT_EQ(summary.result.labels.at("suitcase").complete, 6u);
    expectTheBox(summary.result.map, cameras[c].box);
  }
}

TEST_F(SeveralCameras, OnAStandingRobotShareItsPose)
{
  const auto cameras = fourCameras();
  const auto summary = run(stopAndLook(cameras));
  expectTheBox(summary.result.map, cameras[0].box);
  EXPECT_EQ(summary.result.keyframes.size(), 24u);
  EXPECT_EQ(summary.result.map.confirmedObjects().at(0)->observations(), 18u);

  const auto trajectory = readTumTrajectory(output("trajectory.tum"));
  ASSERT_EQ(trajectory.size(), 6u);
  mrpt::graphs::CNetworkOfPoses3DInf graph;
  graph.loadFromTextFile(output("pose-graph.graph"));
  ASSERT_EQ(graph.nodeCount(), 7u);
  EXPECT_EQ(graph.edgeCount(), 5u + 6u) << "MRPT keeps one edge between two nodes";
  const auto scans = simpleMap("map.simplemap"), objects = simpleMap("objects.simplemap");
  ASSERT_EQ(scans.size(), 6u);
  ASSERT_EQ(objects.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
  {
    const CPose3D pose = cameras[0].robotAt(0.25 * static_cast<double>(i));
    EXPECT_LT((trajectory[i].pose - pose).norm(), 1e-6);
    EXPECT_LT((graph.nodes.at(i) - pose).norm(), 1e-6);
    const auto& [mean, frame] = scans.get(i);
    EXPECT_LT((mean->getMeanVal() - pose).norm(), 1e-6);
    ASSERT_EQ(frame->size(), 4u);
    for (std::size_t c = 0; c < 4; ++c)
    {
      CPose3D T_robot_sensor;
      frame->getObservationByIndex(c)->getSensorPose(T_robot_sensor);
      EXPECT_EQ(frame->getObservationByIndex(c)->sensorLabel, cameras[c].sensor);
      EXPECT_LT((T_robot_sensor - cameras[c].T_robot_camera).norm(), 1e-9);
    }
    EXPECT_EQ(std::get<1>(objects.get(i))->size(), 3u) << "the last camera has no detector";
  }
  CQuadricObjectMap rebuilt;
  rebuilt.loadFromSimpleMap(objects);
  rebuilt.consolidate();
  expectTheBox(rebuilt, cameras[0].box);
}

TEST_F(SeveralCameras, OnAStandingRobotShareItsCorrectedPose)
{
  const auto cameras = fourCameras();
  const auto summary = run(stopAndLook(cameras), true);
  expectTheBox(summary.result.map, cameras[0].box);
  const auto& keyframes = summary.result.keyframes;
  ASSERT_EQ(keyframes.size(), 24u);
  for (std::size_t k = 0; k < keyframes.size(); ++k)
  {
    const auto& first = keyframes[k - k % 4];
    EXPECT_LT((keyframes[k].T_map_robot - first.T_map_robot).norm(), 5e-4);
    // The odometry is exact: what the pixel grid moves stays within the sigma it claims by then.
    // The first pose moves with the map, which settles where all poses agree with the odometry
    // best.
    const double steps = std::max(1.0, static_cast<double>(k / 4));
    const double claimed = PoseUncertaintyOptions().sigmaPosition * std::sqrt(steps);
    EXPECT_LE((keyframes[k].T_map_robot - keyframes[k].T_odom_robot).norm(), claimed + 1e-6);
  }
}

TEST_F(SeveralCameras, OnADrivingRobotKeepTheirPoses)
{
  auto cameras = fourCameras();
  cameras.pop_back();
  const auto summary = run(drivePast(cameras));
  expectTheBox(summary.result.map, cameras[0].box);
  const auto trajectory = readTumTrajectory(output("trajectory.tum"));
  ASSERT_EQ(trajectory.size(), 18u);
  for (std::size_t i = 1; i < trajectory.size(); ++i)
  {
    EXPECT_GT(trajectory[i].time, trajectory[i - 1].time);
    EXPECT_NEAR(
        trajectory[i].pose.y() - trajectory[0].pose.y(),
        0.3 * (trajectory[i].time - trajectory[0].time), 1e-6);
  }
  EXPECT_EQ(simpleMap("map.simplemap").size(), 18u);
}

TEST_F(SeveralCameras, OrderOfTheRecordsDoesNotMatter)
{
  const auto cameras = fourCameras();
  const Records records = stopAndLook(cameras);
  const auto first = run(records).result.map.toRecords();
  const std::string trajectory = readFile(output("trajectory.tum"));
  Records swapped = records;  // at each moment: pose, (scan, boxes) x 3, scan, pose
  for (std::size_t i = 0; i < swapped.size(); i += 9)
  {
    std::swap(swapped[i + 1], swapped[i + 5]);
    std::swap(swapped[i + 2], swapped[i + 6]);
  }
  const auto second = run(swapped).result.map.toRecords();
  EXPECT_EQ(readFile(output("trajectory.tum")), trajectory);
  ASSERT_EQ(first.size(), 1u);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_LT((first[0].object.center() - second[0].object.center()).norm(), 1e-3);
  EXPECT_GT(cuboidIoU(first[0].object, second[0].object), 0.99);
}

TEST_F(SeveralCameras, OneMomentNeedsNoPoses)
{
  const auto cameras = fourCameras();
  Records records = stopAndLook(cameras);
  const auto isPose = [](const auto& object)
  { return std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(object) != nullptr; };
  records.erase(std::remove_if(records.begin(), records.end(), isPose), records.end());
  EXPECT_NE(errorOf([&] { run(records); }).find("no odometry for any image"), std::string::npos);
  records.resize(7);
  const auto summary = run(records);
  EXPECT_EQ(summary.result.counts().keyframes, 4u);
  EXPECT_EQ(summary.result.counts().framesWithoutPose, 0u);
  EXPECT_EQ(readTumTrajectory(output("trajectory.tum")).size(), 1u);
  EXPECT_EQ(summary.result.map.objects().size(), 1u);
}

TEST_F(SeveralCameras, OneMomentHasOneCorrectedPose)
{
  const auto cameras = fourCameras();
  Records records = stopAndLook(cameras);
  records.erase(records.begin());
  records.resize(7);
  const auto summary = run(records, true);
  const auto& keyframes = summary.result.keyframes;
  ASSERT_EQ(keyframes.size(), 4u);
  EXPECT_FALSE(keyframes[0].odometryStep);
  for (std::size_t k = 1; k < 4; ++k)
  {
    ASSERT_TRUE(keyframes[k].odometryStep) << k;
    EXPECT_LT(keyframes[k].odometryStep->mean.norm(), 1e-12);
    EXPECT_LT((keyframes[k].T_map_robot - keyframes[0].T_map_robot).norm(), 5e-4) << k;
  }
}

TEST_F(SeveralCameras, ReportCountsEachSensor)
{
  const auto cameras = fourCameras();
  Records records = stopAndLook(cameras);
  for (std::size_t i = 45; i >= 27; i -= 9)  // the second camera dies half way
    records.erase(
        records.begin() + static_cast<std::ptrdiff_t>(i) + 3,
        records.begin() + static_cast<std::ptrdiff_t>(i) + 5);
  run(records);
  const auto r = report();
  EXPECT_EQ(r["input"]["frames"], 21);
  EXPECT_EQ(r["input"]["poses"], 6);
  const auto& sensors = r["input"]["sensors"];
  ASSERT_EQ(sensors.size(), 4u);
  EXPECT_EQ(sensors["RGBD_1"]["keyframes"], 6);
  EXPECT_EQ(sensors["RGBD_2"]["keyframes"], 3);
  EXPECT_EQ(sensors["RGBD_2"]["boxes"], 3);
  EXPECT_EQ(sensors["RGBD_4"]["keyframes_without_boxes"], 6);
  std::set<std::string> seen;
  for (const auto& keyframe : r["associations"])
  {
    seen.insert(keyframe["sensor"]);
    EXPECT_LT(keyframe["pose"], 6);
  }
  EXPECT_EQ(seen.size(), 3u);
}

TEST_F(SeveralCameras, PixelLabelsNeedNoDetector)
{
  const SyntheticRoom room;
  Records records;
  for (int i = 0; i < kMoments; ++i)
  {
    const CPose3D pose = room.robotAt(0.25 * i);
    const auto scan = room.scanFrom(pose, kStart + i);
    const ImageBox box = room.boxesOf(*scan, pose)->objects.at(0).box;
    scan->pixelLabels = std::make_shared<mrpt::obs::TPixelLabelInfo<1>>();
    scan->pixelLabels->setSize(240, 320);
    scan->pixelLabels->setLabelName(0, "floor");
    scan->pixelLabels->setLabelName(1, "suitcase_1");
    const CPose3D T_map_optical = pose + room.T_robot_camera + T_sensor_optical();
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u)
      {
        const bool inBox = u >= box.x1 && u <= box.x2 && v >= box.y1 && v <= box.y2;
        const Eigen::Vector3d p = room.camera.ray(u, v) * room.depthAt(T_map_optical, u, v);
        const auto p_map = T_map_optical.composePoint(mrpt::math::TPoint3D(p.x(), p.y(), p.z()));
        scan->pixelLabels->setLabel(v, u, inBox && p_map.z > 1e-6 ? 1 : 0);
      }
    records.push_back(samplePose(kStart + i, pose));
    records.push_back(scan);
  }
  const auto summary = run(records);
  expectTheBox(summary.result.map, room.box);
  EXPECT_EQ(summary.result.map.confirmedObjects().at(0)->label(), "suitcase");
  EXPECT_EQ(report()["input"]["keyframes_from_pixel_labels"], 6);
  ASSERT_EQ(summary.result.warnings.size(), 1u) << "the floor is no object, said once";
  EXPECT_NE(summary.result.warnings[0].find("no objects: floor"), std::string::npos);
}
