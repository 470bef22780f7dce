#include <gtest/gtest.h>
#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <cmath>
#include <limits>

#include "../../obs/TestData.h"
#include "../SampleRawlog.h"
#include "quadmap/sensors/RawlogNames.h"

using namespace quadmap;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
constexpr double kClockTick = 1e-6;  // [s]; MRPT stores 1e-7 s, at 1 m/s less than this in metres

double distance(const CPose3D& a, const CPose3D& b)
{
  const CPose3D difference = a - b;
  return std::abs(difference.x()) + std::abs(difference.y()) + std::abs(difference.z()) +
         std::abs(difference.yaw()) + std::abs(difference.pitch()) + std::abs(difference.roll());
}

mrpt::obs::CSensoryFrame::Ptr sensoryFrame(
    const std::vector<mrpt::obs::CObservation::Ptr>& observations)
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  for (const auto& o : observations) frame->insert(o);
  return frame;
}

mrpt::obs::CActionCollection::Ptr movement2D(const CPose2D& increment)
{
  mrpt::obs::CActionRobotMovement2D move;
  move.computeFromOdometry(increment, {});
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(move);
  return actions;
}

mrpt::obs::CActionCollection::Ptr movement3D(const CPose3D& increment)
{
  mrpt::obs::CActionRobotMovement3D move;
  move.poseChange.mean = increment;
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(move);
  return actions;
}

mrpt::obs::CObservationOdometry::Ptr odometry2D(double time, const CPose2D& pose)
{
  auto o = mrpt::obs::CObservationOdometry::Create();
  o->timestamp = stamp(time);
  o->sensorLabel = "wheels";
  o->odometry = pose;
  return o;
}
}  // namespace

TEST(RawlogSource, GivesScansWithTheirBoxesAndPosesAtTheSameTime)
{
  const TemporaryFolder folder;
  const CPose3D T0(1, 2, 3, 0.1, 0.2, 0.3), T1(2, 2, 3, 0.2, 0.2, 0.3);
  const auto file = writeObjects(
      folder.path("x.rawlog"), {samplePose(kStart, T0), sampleScan(kStart), sampleBoxes(kStart),
                                samplePose(kStart + 1, T1), sampleScan(kStart + 1)});
  RawlogSource source(file, {});
  const auto frames = readAll(source);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].record, 1u);
  EXPECT_EQ(frames[1].record, 4u);
  EXPECT_NEAR(frames[0].time(), kStart, kClockTick);
  ASSERT_TRUE(frames[0].objects);
  EXPECT_EQ(frames[0].objects->objects.size(), 2u);
  EXPECT_EQ(frames[0].objects->objects[0].label, "chair");
  EXPECT_FALSE(frames[1].objects) << "nobody looked at the second image";
  ASSERT_TRUE(frames[0].T_odom_robot && frames[1].T_odom_robot);
  EXPECT_LT(distance(*frames[0].T_odom_robot, T0), 1e-9);
  EXPECT_LT(distance(*frames[1].T_odom_robot, T1), 1e-9);
  EXPECT_FALSE(frames[0].T_world_robot);
  EXPECT_EQ(frames[0].scan->rangeImage(5, 7), 1000 + 21 + 5);
  EXPECT_EQ(source.framesRead(), 2u);
  EXPECT_EQ(source.recordsRead(), 5u);
  EXPECT_EQ(source.odometryKind(), "CObservationRobotPose odometry");
  EXPECT_TRUE(source.hasBoxes());
  EXPECT_DOUBLE_EQ(source.progress(), 1.0);
}

TEST(RawlogSource, ReadsUncompressedFilesToo)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), {sampleScan(kStart)}, false);
  EXPECT_EQ(readAll(file).size(), 1u);
}

TEST(RawlogSource, LiftsAndInterpolatesPlanarOdometry)
{
  const TemporaryFolder folder;
  // Driving at 1 m/s and turning at 0.4 rad/s; the camera runs between the odometry's samples, and
  // the second sample comes after its scan.
  const auto at = [](double t) { return CPose2D(t, 0.5 * t, 0.4 * t); };
  const auto file = writeObjects(
      folder.path("x.rawlog"),
      {odometry2D(kStart, at(0)), sampleScan(kStart + 0.025), odometry2D(kStart + 0.1, at(0.1)),
       sampleScan(kStart + 0.175), odometry2D(kStart + 0.2, at(0.2))});
  RawlogSource source(file, {});
  const auto frames = readAll(source);
  ASSERT_EQ(frames.size(), 2u);
  ASSERT_TRUE(frames[0].T_odom_robot && frames[1].T_odom_robot);
  EXPECT_LT(distance(*frames[0].T_odom_robot, CPose3D(at(0.025))), kClockTick);
  EXPECT_LT(distance(*frames[1].T_odom_robot, CPose3D(at(0.175))), kClockTick);
  EXPECT_EQ(source.odometryKind(), "CObservationOdometry wheels");
}

TEST(RawlogSource, InterpolatesRotationsAlongTheShortestArc)
{
  const TemporaryFolder folder;
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
  const auto turned = [&](double angle)
  {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    return CPose3D::FromRotationAndTranslation(R, Eigen::Vector3d(angle, 0, -angle).eval());
  };
  const auto file = writeObjects(
      folder.path("x.rawlog"), {samplePose(kStart, turned(0.2)), sampleScan(kStart + 0.3),
                                samplePose(kStart + 0.5, turned(1.2))});
  const auto frames = readAll(file);
  ASSERT_EQ(frames.size(), 1u);
  ASSERT_TRUE(frames[0].T_odom_robot);
  EXPECT_LT(distance(*frames[0].T_odom_robot, turned(0.8)), 10 * kClockTick) << "at 2 rad/s";
}

TEST(RawlogSource, KnowsTheCovarianceOfEveryKindThatStatesIt)
{
  const TemporaryFolder folder;
  const auto covarianceOf = [&](const std::vector<mrpt::serialization::CSerializable::Ptr>& records)
  {
    const auto frames = readAll(writeObjects(folder.path("x.rawlog"), records));
    EXPECT_TRUE(!frames.empty() && frames.back().odometryCovariance);
    return frames.at(frames.size() - 1).odometryCovariance.value();
  };
  const auto poseAt = [](double time, double variance)
  {
    auto pose = samplePose(time, CPose3D(time - kStart, 0, 0, 0, 0, 0));
    pose->pose.cov(1, 1) = variance;
    return pose;
  };
  const auto interpolated =
      covarianceOf({poseAt(kStart, 0.01), sampleScan(kStart + 0.25), poseAt(kStart + 1, 0.03)});
  EXPECT_NEAR(interpolated(1, 1), 0.015, 1e-7);
  EXPECT_TRUE(covarianceOf({odometry2D(kStart, {}), sampleScan(kStart)}).asEigen().isZero())
      << "silent";

  const auto scanAt = [](double time) { return sensoryFrame({sampleScan(time)}); };
  const auto planar = movement2D(CPose2D(0.5, 0, 0.1));
  CPose3DPDFGaussian once;
  ASSERT_TRUE(planar->getFirstMovementEstimation(once));
  ASSERT_GT(once.cov(0, 0), 0);
  auto twice = once;
  twice += once;
  EXPECT_LT(
      (covarianceOf({planar, scanAt(kStart), planar, scanAt(kStart + 1)}) - twice.cov).maxCoeff(),
      1e-12);
  mrpt::obs::CActionRobotMovement3D move;
  move.poseChange.mean = CPose3D(0.5, 0.1, 0.2, 0, 0, 0);
  move.poseChange.cov(2, 2) = 0.04;
  auto spatial = mrpt::obs::CActionCollection::Create();
  spatial->insert(move);
  EXPECT_NEAR(covarianceOf({spatial, scanAt(kStart)})(2, 2), 0.04, 1e-12);
  move.poseChange.cov(2, 2) = std::numeric_limits<double>::quiet_NaN();
  spatial->clear();
  spatial->insert(move);
  EXPECT_TRUE(covarianceOf({spatial, scanAt(kStart)}).asEigen().isZero()) << "broken: as none";
}

TEST(RawlogSource, DoesNotInventPoses)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"),
      {sampleScan(kStart - 0.1), samplePose(kStart, CPose3D()), sampleScan(kStart + 1),
       samplePose(kStart + 3, CPose3D(1, 0, 0, 0, 0, 0)), sampleScan(kStart + 3.1)});
  const auto frames = readAll(file);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_FALSE(frames[0].T_odom_robot) << "before the first pose";
  EXPECT_FALSE(frames[1].T_odom_robot) << "in a gap of 3 s, 1 s is allowed";
  EXPECT_FALSE(frames[2].T_odom_robot) << "after the last pose";
  RawlogSourceOptions patient;
  patient.maxOdometryGap = 4;
  const auto bridged = readAll(file, patient);
  ASSERT_TRUE(bridged[1].T_odom_robot);
  EXPECT_NEAR(bridged[1].T_odom_robot->x(), 1.0 / 3, kClockTick);
}

TEST(RawlogSource, SumsUpTheActionsOfActionSensoryFrameLogs)
{
  const CPose2D step2(0.5, 0.1, 0.3);
  const CPose3D step3(0.5, 0.1, -0.05, 0.3, 0.02, -0.1);
  const auto check = [](const mrpt::obs::CActionCollection::Ptr& action, const CPose3D& step,
                        const std::string& kind)
  {
    const TemporaryFolder folder;
    const auto file = writeObjects(
        folder.path("x.rawlog"),
        {mrpt::obs::CActionCollection::Create(), sensoryFrame({sampleScan(kStart)}), action,
         sensoryFrame({sampleScan(kStart + 1), sampleScan(kStart + 1, "rear")}), action,
         sensoryFrame({sampleScan(kStart + 2), sampleBoxes(kStart + 2)})});
    RawlogSource source(file, {});
    const auto frames = readAll(source);
    ASSERT_EQ(frames.size(), 4u);
    for (const auto& frame : frames) ASSERT_TRUE(frame.T_odom_robot);
    EXPECT_LT(distance(*frames[0].T_odom_robot, CPose3D()), 1e-9);
    EXPECT_LT(distance(*frames[1].T_odom_robot, step), 1e-9);
    EXPECT_LT(distance(*frames[2].T_odom_robot, step), 1e-9) << "the other sensor, same moment";
    EXPECT_LT(distance(*frames[3].T_odom_robot, step + step), 1e-9);
    EXPECT_TRUE(frames[3].objects) << "boxes in the same sensory frame";
    EXPECT_EQ(source.odometryKind(), kind);
  };
  check(movement2D(step2), CPose3D(step2), "CActionRobotMovement2D");
  check(movement3D(step3), step3, "CActionRobotMovement3D");
}

TEST(RawlogSource, KeepsTheTruePoseApartFromOdometry)
{
  const TemporaryFolder folder;
  const CPose3D truth(5, 5, 5, 0, 0, 0), odometry(1, 0, 0, 0, 0, 0);
  const auto file = writeObjects(
      folder.path("x.rawlog"), {samplePose(kStart, truth, "ground_truth"),
                                samplePose(kStart, odometry), sampleScan(kStart)});
  RawlogSource source(file, {});
  const auto frames = readAll(source);
  ASSERT_EQ(frames.size(), 1u);
  ASSERT_TRUE(frames[0].T_world_robot && frames[0].T_odom_robot);
  EXPECT_LT(distance(*frames[0].T_world_robot, truth), 1e-9);
  EXPECT_LT(distance(*frames[0].T_odom_robot, odometry), 1e-9);
}

TEST(RawlogSource, StaysWithTheFirstSourceOfOdometry)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"),
      {odometry2D(kStart, CPose2D(1, 0, 0)), samplePose(kStart, CPose3D(9, 9, 9, 0, 0, 0), "gps"),
       sampleScan(kStart)});
  RawlogSource source(file, {});
  source.setVerbosityLevel(mrpt::system::LVL_ERROR);
  const auto frames = readAll(source);
  ASSERT_EQ(frames.size(), 1u);
  ASSERT_TRUE(frames[0].T_odom_robot);
  EXPECT_DOUBLE_EQ(frames[0].T_odom_robot->x(), 1.0);
}

TEST(RawlogSource, PairsTheSidecarBySensorAndTime)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"), {sampleScan(kStart, "left"), sampleScan(kStart, "right"),
                                sampleScan(kStart + 1, "left"), sampleScan(kStart + 2, "left")});
  auto right = sampleBoxes(kStart, "right");
  right->objects.resize(1);
  auto nobody = sampleBoxes(kStart + 2, "left");
  nobody->objects.clear();
  writeObjects(
      folder.path("x.objects.rawlog"), {right, sampleBoxes(kStart + 1.004, "left"), nobody});
  const auto frames = readAll(file);
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_FALSE(frames[0].objects);
  ASSERT_TRUE(frames[1].objects);
  EXPECT_EQ(frames[1].objects->objects.size(), 1u);
  EXPECT_TRUE(frames[2].objects) << "4 ms late, 5 ms are allowed";
  ASSERT_TRUE(frames[3].objects) << "an empty list means: looked, nothing seen";
  EXPECT_TRUE(frames[3].objects->objects.empty());
}

TEST(RawlogSource, WaitsForBoxesThatWereRecordedLate)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"),
      {sampleScan(kStart), sampleBoxes(kStart), sampleScan(kStart + 0.1), sampleScan(kStart + 0.2),
       sampleBoxes(kStart + 0.1), sampleScan(kStart + 0.3), sampleBoxes(kStart + 0.3)});
  const auto frames = readAll(file);
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_TRUE(frames[0].objects);
  EXPECT_TRUE(frames[1].objects) << "its boxes come after the next scan";
  EXPECT_FALSE(frames[2].objects);
  EXPECT_TRUE(frames[3].objects);
}

TEST(RawlogSource, FindsTheSidecarOfCompressedNames)
{
  EXPECT_EQ(objectsFileOf("d/x.rawlog"), "d/x.objects.rawlog");
  EXPECT_EQ(objectsFileOf("d/x.rawlog.gz"), "d/x.objects.rawlog.gz");
  EXPECT_EQ(objectsFileOf("x"), "x.objects.rawlog");
  EXPECT_EQ(imagesFolderOf("d/x.rawlog.gz"), "d/x_Images");
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog.gz"), {sampleScan(kStart)});
  writeObjects(folder.path("x.objects.rawlog.gz"), {sampleBoxes(kStart)});
  const auto frames = readAll(file);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_TRUE(frames[0].objects);
}

TEST(RawlogSource, HasBoxesOnlyWhenTheSidecarHasSome)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), {sampleScan(kStart)});
  const auto hasBoxes = [&](const std::vector<mrpt::serialization::CSerializable::Ptr>& sidecar)
  {
    writeObjects(folder.path("x.objects.rawlog"), sidecar);
    RawlogSource source(file, {});
    EXPECT_EQ(readAll(source).size(), 1u);
    return source.hasBoxes();
  };
  EXPECT_FALSE(hasBoxes({}));
  EXPECT_FALSE(hasBoxes({samplePose(kStart, CPose3D())}));
  auto nothingSeen = sampleBoxes(kStart);
  nothingSeen->objects.clear();
  EXPECT_TRUE(hasBoxes({nothingSeen})) << "somebody looked";
  EXPECT_TRUE(hasBoxes({sampleBoxes(kStart)}));
  folder.write("x.objects.rawlog", "");
  RawlogSource source(file, {});
  EXPECT_EQ(readAll(source).size(), 1u);
  EXPECT_FALSE(source.hasBoxes()) << "a file of 0 bytes";
}

TEST(RawlogSource, LeavesBoxesAloneWhenAsked)
{
  const TemporaryFolder folder;
  RawlogSourceOptions options;
  options.readBoxes = false;
  const auto rawlog =
      writeObjects(folder.path("x.rawlog"), {sampleScan(kStart), sampleBoxes(kStart)});
  EXPECT_FALSE(readAll(rawlog, options).at(0).objects) << "those in the rawlog";
  folder.write("x.objects.rawlog", "nonsense");
  EXPECT_FALSE(readAll(rawlog, options).at(0).objects) << "those beside it";
  EXPECT_THROW(readAll(rawlog), std::runtime_error);
}

TEST(RawlogSource, SelectsOneSensor)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"),
      {sampleScan(kStart, "left"), sampleScan(kStart, "right"), sampleBoxes(kStart, "left")});
  RawlogSourceOptions options;
  options.sensorLabel = "right";
  RawlogSource source(file, options);
  const auto frames = readAll(source);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].scan->sensorLabel, "right");
  options.sensorLabel = "rear";
  EXPECT_TRUE(readAll(file, options).empty());
}

TEST(RawlogSource, TurnsRangesAlongTheRaysIntoDepths)
{
  const TemporaryFolder folder;
  auto scan = sampleScan(kStart);
  scan->range_is_depth = false;
  // A wall 2 m ahead: along the ray of pixel (u, v) it is 2 m / cos(angle to the optical axis)
  // away.
  const auto& c = scan->cameraParams;
  for (int v = 0; v < kRows; ++v)
    for (int u = 0; u < kColumns; ++u)
    {
      const Eigen::Vector3d ray((u - c.cx()) / c.fx(), (v - c.cy()) / c.fy(), 1);
      const double cosine = ray.normalized().z();
      scan->rangeImage(v, u) = static_cast<std::uint16_t>(std::lround(2000 / cosine));
    }
  scan->rangeImage(0, 0) = 0;
  const auto frames = readAll(writeObjects(folder.path("x.rawlog"), {scan}));
  ASSERT_EQ(frames.size(), 1u);
  const auto& depth = frames[0].scan->rangeImage;
  EXPECT_TRUE(frames[0].scan->range_is_depth);
  EXPECT_EQ(depth(0, 0), 0) << "nothing measured stays so";
  for (int v = 1; v < kRows; ++v)
    for (int u = 0; u < kColumns; ++u) ASSERT_NEAR(depth(v, u), 2000, 1) << "[mm], rounded twice";
}

TEST(RawlogSource, AcceptsScansWithoutColourNegativeFyAndAllZeroDepth)
{
  const TemporaryFolder folder;
  auto gray = sampleScan(kStart);
  gray->hasIntensityImage = false;
  auto flipped = sampleScan(kStart + 1);
  flipped->cameraParams.setIntrinsicParamsFromValues(481.2, -480.0, 31.5, 23.5);
  auto blind = sampleScan(kStart + 2);
  blind->rangeImage.fill(0);
  const auto frames = readAll(writeObjects(folder.path("x.rawlog"), {gray, flipped, blind}));
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_FALSE(frames[0].scan->hasIntensityImage);
  EXPECT_DOUBLE_EQ(frames[1].scan->cameraParams.fy(), 480.0) << "the image was turned";
  EXPECT_EQ(frames[2].scan->rangeImage.asEigen().cast<int>().sum(), 0);
}

TEST(RawlogSource, HoldsFewFramesWhileItWaitsForPoses)
{
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> objects;
  for (int i = 0; i < 100; ++i) objects.push_back(sampleScan(kStart + 0.01 * i));
  RawlogSource source(writeObjects(folder.path("x.rawlog"), objects), {});
  std::size_t frames = 0;
  while (source.next())
  {
    ++frames;
    EXPECT_LE(source.recordsRead() - frames, 33u) << "frames in memory";
  }
  EXPECT_EQ(frames, 100u);
}

TEST(RawlogSource, SaysWhatIsInAFileWithoutRgbd)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"), {samplePose(kStart, CPose3D()), samplePose(kStart + 1, CPose3D()),
                                mrpt::obs::CActionCollection::Create(),
                                sensoryFrame({mrpt::obs::CObservationComment::Create()})});
  RawlogSource source(file, {});
  EXPECT_FALSE(source.next());
  EXPECT_EQ(source.framesRead(), 0u);
  EXPECT_FALSE(source.hasBoxes());
  EXPECT_EQ(
      source.contentSummary(),
      "2 CObservationRobotPose, 1 CActionCollection, 1 CObservationComment");
}

TEST(RawlogSource, ReadsTheRawlogsOfMrpt)
{
  if (testData("mrpt").empty()) GTEST_SKIP() << "the recordings are not here";
  RawlogSource rgbd(testData("mrpt/tests_rgbd.rawlog"), {});
  rgbd.setVerbosityLevel(mrpt::system::LVL_ERROR);
  const auto frames = readAll(rgbd);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].scan->sensorLabel, "OPENNI2");
  EXPECT_GT(frames[0].scan->rangeImage.asEigen().cast<int>().maxCoeff(), 0);

  const auto expectNoRgbd =
      [](const std::string& name, const std::string& content, const std::string& odometry)
  {
    RawlogSource source(testData("mrpt/" + name), {});
    EXPECT_FALSE(source.next());
    EXPECT_EQ(source.contentSummary(), content);
    EXPECT_EQ(source.odometryKind(), "CActionRobotMovement" + odometry);
  };
  expectNoRgbd(
      "localization_demo.rawlog", "37 CActionCollection, 37 CObservation2DRangeScan", "2D");
  expectNoRgbd("kf-slam_demo.rawlog", "250 CActionCollection, 250 CObservationBearingRange", "2D");
  expectNoRgbd(
      "kf-slam_6D_demo.rawlog", "600 CActionCollection, 600 CObservationBearingRange", "3D");
}

TEST(RawlogSource, CanBeStoppedWhereNoImagesAre)
{
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  for (int i = 0; i < 100; ++i) records.push_back(samplePose(kStart + 0.1 * i, {}));
  records.push_back(sampleScan(kStart + 5));
  int asked = 0;
  RawlogSourceOptions options;
  options.shouldStop = [&] { return ++asked > 10; };
  RawlogSource source(writeObjects(folder.path("x.rawlog"), records), options);
  EXPECT_FALSE(source.next());
  EXPECT_EQ(source.recordsRead(), 10u);
}
