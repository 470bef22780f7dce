#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement3D.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "RawlogProblems.h"
#include "quadmap/sensors/RawlogWriter.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/** Writes a rawlog whose pose at x = 1234.5 m has a quaternion of zeros. */
std::string withoutRotation(
    const TemporaryFolder& folder,
    const std::vector<mrpt::serialization::CSerializable::Ptr>& objects)
{
  std::string bytes = readFile(writeObjects(folder.path("x.rawlog"), objects, false));
  const double x = 1234.5, one = 1;
  const std::string xBytes(reinterpret_cast<const char*>(&x), sizeof x);
  const std::string oneBytes(reinterpret_cast<const char*>(&one), sizeof one);
  const auto real = bytes.find(oneBytes, bytes.find(xBytes));
  EXPECT_LT(real, bytes.size());
  bytes.replace(real, sizeof one, std::string(sizeof one, '\0'));
  return folder.write("x.rawlog", bytes);
}

/** Writes three scans, of which the middle one is changed. */
std::string writeWithBadScan(
    const TemporaryFolder& folder,
    const std::function<void(mrpt::obs::CObservation3DRangeScan&)>& spoil)
{
  auto scan = sampleScan(kStart + 1);
  spoil(*scan);
  return writeObjects(folder.path("x.rawlog"), {sampleScan(kStart), scan, sampleScan(kStart + 2)});
}
}  // namespace

TEST(RawlogErrors, CalibrationOfAnotherImageSize)
{
  const TemporaryFolder folder;
  const auto file = folder.path("x.rawlog");
  for (const bool isExternal : {false, true})
  {
    SCOPED_TRACE(isExternal);
    RawlogWriterOptions options;
    options.external = isExternal;
    RawlogWriter writer(file, options);
    auto scan = sampleScan(kStart);
    scan->cameraParams.ncols = 640;
    scan->cameraParams.nrows = 480;
    writer.write(*scan);
    writer.write(*sampleScan(kStart + 1));
    writer.finish();
    ::testing::internal::CaptureStderr();
    expectProblem(
        file,
        {"x.rawlog: record 0 (camera): ",
         "its calibration is for 640x480 images, its depth image has 64x48"},
        1);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "MRPT prints nothing";
  }
}

TEST(RawlogErrors, ScansNobodyCanUse)
{
  using Scan = mrpt::obs::CObservation3DRangeScan;
  const auto expect = [](const std::string& what, const std::function<void(Scan&)>& spoil)
  {
    SCOPED_TRACE(what);
    const TemporaryFolder folder;
    expectProblem(writeWithBadScan(folder, spoil), {"x.rawlog: record 1 (camera): ", what}, 2);
  };
  const std::string noCalibration = "has no camera calibration";
  expect(noCalibration, [](Scan& s) { s.cameraParams.intrinsicParams(0, 0) = 0; });
  expect(noCalibration, [](Scan& s) { s.cameraParams.intrinsicParams(1, 1) = 0; });
  expect(noCalibration, [](Scan& s) { s.cameraParams.intrinsicParams(0, 2) = kNaN; });
  expect("rangeUnits=0", [](Scan& s) { s.rangeUnits = 0; });
  expect("rangeUnits=inf", [](Scan& s) { s.rangeUnits = HUGE_VALF; });
  expect("rangeUnits=1e-30", [](Scan& s) { s.rangeUnits = 1e-30f; });
  expect("rangeUnits=nan", [](Scan& s) { s.rangeUnits = static_cast<float>(kNaN); });
  expect("has no range image", [](Scan& s) { s.hasRangeImage = false; });
  expect(
      "has 3D points but no range image",
      [](Scan& s)
      {
        s.hasRangeImage = false;
        s.hasPoints3D = true;
        s.resizePoints3DVectors(3);
      });
  expect("its sensorPose", [](Scan& s) { s.sensorPose.x(kNaN); });
  expect("its sensorPose is 1e+300 m away", [](Scan& s) { s.sensorPose.x(1e300); });
  const std::string noRotation = "its sensorPose has no rotation";
  const auto turn = [](double xx, double others)
  {
    const Eigen::Vector4d diagonal(xx, others, others, 1);
    return CPose3D(mrpt::math::CMatrixDouble44(Eigen::Matrix4d(diagonal.asDiagonal())));
  };
  expect(noRotation, [&](Scan& s) { s.sensorPose = turn(0, 0); });
  expect(noRotation, [&](Scan& s) { s.sensorPose = turn(1e300, 1e300); });
  expect(noRotation, [&](Scan& s) { s.sensorPose = turn(-1, 1); });
  expect(
      "its relativePoseIntensityWRTDepth has no rotation",
      [&](Scan& s) { s.relativePoseIntensityWRTDepth = turn(0, 0); });
  expect("has no time stamp", [](Scan& s) { s.timestamp = INVALID_TIMESTAMP; });
  const std::string back = "time goes backwards: ";
  expect(back + "0.500000 s", [](Scan& s) { s.timestamp = stamp(kStart - 0.5); });
  expect("has the time of the scan before", [](Scan& s) { s.timestamp = stamp(kStart); });
  const auto far = std::numeric_limits<mrpt::Clock::rep>::max();
  for (const mrpt::Clock::rep ticks : {mrpt::Clock::rep{1}, far / 2, far})
    expect(
        "s, which is absurd",
        [&](Scan& s) { s.timestamp = mrpt::Clock::time_point(mrpt::Clock::duration(ticks)); });
}

TEST(RawlogErrors, TimesOfPosesThatNoRecordingHas)
{
  const TemporaryFolder folder;
  const auto far = std::numeric_limits<mrpt::Clock::rep>::max();
  for (const mrpt::Clock::rep ticks : {mrpt::Clock::rep{1}, far / 2, far})
    for (const char* track : {"odometry", "ground_truth"})
    {
      const auto last = samplePose(kStart + 1, {});
      last->sensorLabel = track;
      last->timestamp = mrpt::Clock::time_point(mrpt::Clock::duration(ticks));
      expectProblem(
          writeObjects(folder.path("x.rawlog"), {samplePose(kStart, {}), sampleScan(kStart), last}),
          {std::string("x.rawlog: record 2 (") + track + "): has the time ", "absurd"}, 1);
    }
}

TEST(RawlogErrors, PosesNobodyCanUse)
{
  const TemporaryFolder folder;
  const CPose3D somewhere(1, 0, 0, 0, 0, 0);
  expectProblem(
      writeObjects(
          folder.path("x.rawlog"),
          {samplePose(kStart, CPose3D(kNaN, 0, 0, 0, 0, 0)), sampleScan(kStart)}),
      {"x.rawlog: record 0 (odometry): ", "not finite"}, 1);
  expectProblem(
      writeObjects(
          folder.path("x.rawlog"),
          {samplePose(kStart, CPose3D(1e300, 0, 0, 0, 0, 0)), sampleScan(kStart)}),
      {"x.rawlog: record 0 (odometry): ", "absurd"}, 1);
  expectProblem(
      withoutRotation(
          folder, {samplePose(kStart, CPose3D(1234.5, 0, 0, 0, 0, 0)), sampleScan(kStart)}),
      {"x.rawlog: record 0 (odometry): ", "quaternion"}, 1);
  expectProblem(
      writeObjects(
          folder.path("x.rawlog"),
          {samplePose(kStart, somewhere), sampleScan(kStart), samplePose(kStart - 2, somewhere)}),
      {"x.rawlog: record 2 (odometry): ", "goes back by 2.000000 s"}, 1);
}

TEST(RawlogErrors, CovariancesNobodyCanUse)
{
  const TemporaryFolder folder;
  using Covariance = mrpt::math::CMatrixDouble66;
  const auto expect = [&](const std::string& what, const std::function<void(Covariance&)>& spoil)
  {
    SCOPED_TRACE(what);
    const auto pose = samplePose(kStart, CPose3D(1, 0, 0, 0, 0, 0));
    pose->pose.cov.setDiagonal(6, 0.01);
    spoil(pose->pose.cov);
    expectProblem(
        writeObjects(folder.path("x.rawlog"), {pose, sampleScan(kStart)}),
        {"x.rawlog: record 0 (odometry): the pose has ", what}, 1);
    mrpt::obs::CActionRobotMovement3D move;
    move.poseChange = pose->pose;
    auto actions = mrpt::obs::CActionCollection::Create();
    actions->insert(move);
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(sampleScan(kStart));
    expectProblem(
        writeObjects(folder.path("x.rawlog"), {actions, frame}),
        {"x.rawlog: record 0: the movement has ", what}, 1);
  };
  expect("a covariance of 1e+30, which is absurd", [](Covariance& c) { c.fill(1e30); });
  expect("the negative variance -1", [](Covariance& c) { c.fill(-1); });
  expect(
      "the negative variance -1",
      [](Covariance& c)
      {
        c(0, 0) = -1;
        c(2, 2) = 1e9;  // unknown
      });
  expect("a covariance that is not positive", [](Covariance& c) { c(1, 0) = c(0, 1) = 0.02; });
}

TEST(RawlogErrors, LegalCovariancesAreTaken)
{
  const TemporaryFolder folder;
  for (const double unknown : {0.0, 1e6, 1e9})
  {
    const auto pose = samplePose(kStart, {});
    pose->pose.cov(0, 0) = 0.01;
    pose->pose.cov(2, 2) = pose->pose.cov(4, 4) = unknown;
    EXPECT_EQ(
        readAll(writeObjects(folder.path("x.rawlog"), {pose, sampleScan(kStart)})).size(), 1u);
    pose->pose.cov.fill(unknown);  // fully correlated
    EXPECT_EQ(
        readAll(writeObjects(folder.path("x.rawlog"), {pose, sampleScan(kStart)})).size(), 1u);
  }
}

TEST(RawlogErrors, BoxesNobodyCanUse)
{
  const auto expect = [](const std::string& what, const ImageBox& box, double score = 1)
  {
    SCOPED_TRACE(what);
    const TemporaryFolder folder;
    auto boxes = sampleBoxes(kStart);
    boxes->objects[1].box = box;
    boxes->objects[1].score = score;
    const auto file = writeObjects(folder.path("x.rawlog"), {sampleScan(kStart)});
    writeObjects(folder.path("x.objects.rawlog"), {boxes});
    expectProblem(file, {"x.objects.rawlog: record 0 (camera): box 1 (cup): ", what}, 1);
    RawlogSource source(file, keepGoing());
    const auto frames = readAll(source);
    ASSERT_TRUE(frames.at(0).objects);
    EXPECT_EQ(frames[0].objects->objects.size(), 1u) << "the good box stays";
  };
  expect("not finite", {kNaN, 1, 5, 5});
  expect("not finite", {1, 1, HUGE_VAL, 5});
  expect("is inverted", {9, 1, 5, 5});
  expect("is inverted", {1, 9, 5, 5});
  expect("has no area", {5, 5, 5, 9});
  expect("has no area", {5, 5, 9, 5});
  expect("outside the 64x48 image", {70, 5, 80, 9});
  expect("outside the 64x48 image", {5, -9, 8, -2});
  expect("reaches far outside the 64x48 image", {-1e300, -1e300, 1e300, 1e300});
  expect("reaches far outside the 64x48 image", {1, 1, 5, 641});
  expect("score 1.5", {1, 1, 5, 5}, 1.5);
  expect("score nan", {1, 1, 5, 5}, kNaN);
}

TEST(RawlogErrors, BoxesOfAnotherImage)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), {sampleScan(kStart)});
  const auto expect = [&](const CObservationObjects::Ptr& boxes, const std::string& what)
  {
    writeObjects(folder.path("x.objects.rawlog"), {boxes});
    expectProblem(file, {"x.objects.rawlog: record 0 (camera): ", what}, 1);
    RawlogSource source(file, keepGoing());
    EXPECT_FALSE(readAll(source).at(0).objects);
  };
  auto size = sampleBoxes(kStart), calibration = sampleBoxes(kStart), pose = sampleBoxes(kStart);
  size->cameraParams.ncols = 640;
  expect(size, "of a 640x48 image, the scan has 64x48");
  calibration->cameraParams.intrinsicParams(1, 1) *= -1;
  expect(calibration, "another calibration");
  pose->sensorPose = CPose3D(0, 0, 1, 0, 0, 0);
  expect(pose, "another sensorPose");
}

TEST(RawlogErrors, BoxesThatAllMissTheirScans)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), {sampleScan(kStart)});
  writeObjects(
      folder.path("x.objects.rawlog"), {sampleBoxes(kStart + 9), sampleBoxes(kStart + 10)});
  expectProblem(file, {"x.objects.rawlog: ", "2 records of boxes match no scan"}, 1);
}

TEST(RawlogErrors, BadSidecar)
{
  const TemporaryFolder folder;
  const auto file =
      writeObjects(folder.path("x.rawlog"), {sampleScan(kStart), sampleScan(kStart + 1)});
  const auto sidecar = folder.path("x.objects.rawlog");
  const auto whole =
      readFile(writeObjects(sidecar, {sampleBoxes(kStart), sampleBoxes(kStart + 1)}, false));
  folder.write("x.objects.rawlog", whole.substr(0, whole.size() - 10));
  expectProblem(file, {"x.objects.rawlog: record 1: ", "truncated"}, 2);

  auto timeless = sampleBoxes(kStart);
  timeless->timestamp = INVALID_TIMESTAMP;
  writeObjects(sidecar, {sampleBoxes(kStart), timeless, sampleBoxes(kStart + 1)});
  expectProblem(file, {"x.objects.rawlog: record 1 (camera): ", "have no time stamp"}, 2);
}
