#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "../SampleRawlog.h"
#include "quadmap/sensors/RawlogWriter.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

RawlogSourceOptions keepGoing()
{
  RawlogSourceOptions options;
  options.keepGoing = true;
  return options;
}

/** Expects that strict reading fails with one line that has all of `parts`, and that reading with
 * keepGoing gives `framesLeft` frames and lists the same line. */
void expectProblem(
    const std::string& file, const std::vector<std::string>& parts, std::size_t framesLeft)
{
  const std::string error = errorOf([&] { readAll(file); });
  for (const auto& part : parts)
    EXPECT_NE(error.find(part), std::string::npos) << "'" << part << "' is not in: " << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;

  RawlogSource source(file, keepGoing());
  EXPECT_EQ(readAll(source).size(), framesLeft);
  ASSERT_FALSE(source.problems().empty());
  EXPECT_EQ(source.problems().front().text(), error);
}

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

/** Number of bytes that zlib's own decoder gets from the beginning of a gzip file. */
std::size_t inflatedBytes(std::string compressed)
{
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  EXPECT_EQ(inflateInit2(&stream, kGzip), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(compressed.data());
  stream.avail_in = static_cast<uInt>(compressed.size());
  std::vector<Bytef> out(1u << 20);
  int result = Z_OK;
  while (result == Z_OK)
  {
    stream.next_out = out.data();
    stream.avail_out = static_cast<uInt>(out.size());
    result = inflate(&stream, Z_NO_FLUSH);
  }
  EXPECT_TRUE(result == Z_BUF_ERROR || result == Z_STREAM_END);
  const std::size_t bytes = stream.total_out;
  inflateEnd(&stream);
  return bytes;
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

TEST(RawlogErrors, MissingFileAndFolder)
{
  const TemporaryFolder folder;
  const auto missing = folder.path("no.rawlog");
  EXPECT_EQ(
      errorOf([&] { readAll(missing); }), missing + ": cannot open: No such file or directory");
  const auto name = folder.folder().string();
  EXPECT_EQ(errorOf([&] { readAll(name); }), name + ": is a directory, not a file");
}

TEST(RawlogErrors, MissingSidecarThatWasAskedFor)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), {sampleScan(kStart)});
  RawlogSourceOptions options;
  options.objectsFile = folder.path("no.objects.rawlog");
  EXPECT_EQ(
      errorOf([&] { readAll(file, options); }),
      options.objectsFile + ": cannot open: No such file or directory");
}

TEST(RawlogErrors, OptionsOutOfRange)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(folder.path("x.rawlog"), {sampleScan(kStart)});
  RawlogSourceOptions delay, gap;
  delay.maxBoxDelay = -1;
  gap.maxOdometryGap = 0;
  EXPECT_THROW(readAll(file, delay), std::invalid_argument);
  EXPECT_THROW(readAll(file, gap), std::invalid_argument);
}

TEST(RawlogErrors, NotARawlog)
{
  const TemporaryFolder folder;
  expectProblem(
      folder.write("x.rawlog", "This is a letter to nobody in particular.\n"),
      {"x.rawlog: record 0: ", "not a rawlog"}, 0);
}

TEST(RawlogErrors, EmptyFileHasNoFrames)
{
  const TemporaryFolder folder;
  RawlogSource source(folder.write("x.rawlog", ""), {});
  EXPECT_FALSE(source.next());
  EXPECT_EQ(source.contentSummary(), "nothing");
}

TEST(RawlogErrors, TruncatedCompressedFileAtAnyPlace)
{
  const TemporaryFolder folder;
  const auto whole =
      readFile(writeObjects(folder.path("x.rawlog"), {sampleScan(kStart), sampleScan(kStart + 1)}));
  for (const double share : {0.3, 0.5, 0.7, 0.9, 0.999})
  {
    const auto bytes = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    const auto file = folder.write("x.rawlog", whole.substr(0, bytes));
    const std::string error = errorOf([&] { readAll(file); });
    EXPECT_NE(error.find("x.rawlog: record "), std::string::npos) << share << ": " << error;
    EXPECT_NE(error.find("truncated"), std::string::npos) << share << ": " << error;
    RawlogSource source(file, keepGoing());
    EXPECT_LE(readAll(source).size(), 2u);
    EXPECT_EQ(source.problems().size(), 1u);
  }
}

TEST(RawlogErrors, TruncatedCompressedFileKeepsEveryCompleteFrame)
{
  constexpr std::size_t kScans = 60;
  const TemporaryFolder folder;
  std::vector<mrpt::serialization::CSerializable::Ptr> scans;
  for (std::size_t i = 0; i < kScans; ++i)
    scans.push_back(sampleScan(kStart + static_cast<double>(i)));
  const auto whole = readFile(writeObjects(folder.path("x.rawlog"), scans));
  const std::size_t scanBytes = inflatedBytes(whole) / kScans;  // the scans differ in time only
  ASSERT_EQ(scanBytes * kScans, inflatedBytes(whole));
  std::size_t mostFrames = 0;
  for (const double share : {0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 0.999})
  {
    const auto bytes = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    const auto cut = whole.substr(0, bytes);
    RawlogSource source(folder.write("x.rawlog", cut), keepGoing());
    const std::size_t complete = inflatedBytes(cut) / scanBytes, frames = readAll(source).size();
    EXPECT_EQ(frames, complete) << share;
    ASSERT_EQ(source.problems().size(), 1u) << share;
    EXPECT_NE(source.problems()[0].text().find("truncated"), std::string::npos);
    mostFrames = std::max(mostFrames, frames);
  }
  EXPECT_GE(mostFrames, kScans - 1);
}

TEST(RawlogErrors, TruncatedUncompressedFile)
{
  const TemporaryFolder folder;
  const auto whole = readFile(
      writeObjects(folder.path("x.rawlog"), {sampleScan(kStart), sampleScan(kStart + 1)}, false));
  expectProblem(
      folder.write("x.rawlog", whole.substr(0, whole.size() - 100)),
      {"x.rawlog: record 1: ", "CObservation3DRangeScan", "truncated"}, 1);
}

TEST(RawlogErrors, DamagedCompressedFile)
{
  const TemporaryFolder folder;
  auto bytes =
      readFile(writeObjects(folder.path("x.rawlog"), {sampleScan(kStart), sampleScan(kStart + 1)}));
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 40; ++i) bytes[i] = '\x55';
  const auto file = folder.write("x.rawlog", bytes);
  const std::string error = errorOf([&] { readAll(file); });
  EXPECT_NE(error.find("x.rawlog: record "), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

TEST(RawlogErrors, UnknownClass)
{
  const TemporaryFolder folder;
  auto bytes = readFile(writeObjects(
      folder.path("x.rawlog"),
      {sampleScan(kStart), samplePose(kStart, CPose3D()), sampleScan(kStart + 1)}, false));
  const auto at = bytes.find("CObservationRobotPose");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 21, "CObservationRobotNose");
  expectProblem(
      folder.write("x.rawlog", bytes), {"x.rawlog: record 1: ", "CObservationRobotNose", "unknown"},
      1);
}

TEST(RawlogErrors, UnknownClassInsideASensoryFrame)
{
  const TemporaryFolder folder;
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(samplePose(kStart, CPose3D()));
  auto bytes = readFile(writeObjects(folder.path("x.rawlog"), {sampleScan(kStart), frame}, false));
  const auto at = bytes.find("CObservationRobotPose");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 21, "CObservationRobotNose");
  expectProblem(
      folder.write("x.rawlog", bytes),
      {"x.rawlog: record 1: ", "CSensoryFrame", "CObservationRobotNose"}, 1);
}

TEST(RawlogErrors, MissingExternalImages)
{
  const TemporaryFolder folder;
  const auto file = folder.path("x.rawlog");
  RawlogWriterOptions external;
  external.external = true;
  RawlogWriter writer(file, external);
  for (int i = 0; i < 3; ++i) writer.write(*sampleScan(kStart + i));
  writer.finish();
  ASSERT_EQ(readAll(file).size(), 3u);

  ASSERT_TRUE(std::filesystem::remove(folder.path("x_Images/camera_000001.jpg")));
  expectProblem(file, {"x.rawlog: record 1 (camera): ", "camera_000001.jpg", "missing"}, 2);
  ASSERT_TRUE(std::filesystem::remove(folder.path("x_Images/camera_000002_depth.bin")));
  RawlogSource source(file, keepGoing());
  EXPECT_EQ(readAll(source).size(), 1u);
  ASSERT_EQ(source.problems().size(), 2u);
  EXPECT_NE(source.problems()[1].text().find("camera_000002_depth.bin"), std::string::npos);
}

TEST(RawlogErrors, UnreadableExternalImages)
{
  const TemporaryFolder folder;
  const auto file = folder.path("x.rawlog");
  RawlogWriterOptions external;
  external.external = true;
  RawlogWriter writer(file, external);
  for (int i = 0; i < 2; ++i) writer.write(*sampleScan(kStart + i));
  writer.finish();
  const std::string depth = "x_Images/camera_000001_depth.bin",
                    color = "x_Images/camera_000001.jpg";
  const auto goodDepth = readFile(folder.path(depth)), goodColor = readFile(folder.path(color));

  const std::string where = "x.rawlog: record 1 (camera): ";
  folder.write(depth, "no depth here");
  expectProblem(file, {where, depth + " cannot be read: ", "not plausible"}, 1);
  folder.write(depth, goodDepth.substr(0, goodDepth.size() / 2));
  expectProblem(file, {where, depth + " cannot be read: ", "truncated"}, 1);
  folder.write(depth, "");
  expectProblem(file, {where, depth + " cannot be read: ", "empty"}, 1);
  folder.write(depth, goodDepth);
  folder.write(color, "no image here");
  expectProblem(file, {where, color + " cannot be read"}, 1);
  folder.write(color, goodColor.substr(0, goodColor.size() / 2));
  ::testing::internal::CaptureStderr();
  expectProblem(file, {where, color + " cannot be read", "cannot be read as an image"}, 1);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "libjpeg prints nothing itself";
  folder.write(color, goodColor);
  EXPECT_EQ(readAll(file).size(), 2u);
}

TEST(RawlogErrors, CalibrationOfAnotherImageSize)
{
  const TemporaryFolder folder;
  const auto file = folder.path("x.rawlog");
  RawlogWriterOptions external;  // of embedded images MRPT overwrites the calibration's size
  external.external = true;
  RawlogWriter writer(file, external);
  auto scan = sampleScan(kStart);
  scan->cameraParams.ncols = 640;
  scan->cameraParams.nrows = 480;
  writer.write(*scan);
  writer.write(*sampleScan(kStart + 1));
  writer.finish();
  expectProblem(
      file,
      {"x.rawlog: record 0 (camera): ",
       "its calibration is for 640x480 images, its depth image has 64x48"},
      1);
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
  expect(back + "0.000000 s", [](Scan& s) { s.timestamp = stamp(kStart); });
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

TEST(RawlogErrors, ExternalImagesOutsideTheFolder)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  fs::create_directory(folder.path("x_Images"));
  fs::create_directory(folder.path("other"));
  const auto picture = sampleScan(kStart)->intensityImage;
  ASSERT_TRUE(picture.saveToFile(folder.path("other/secret.jpg")));
  ASSERT_TRUE(picture.saveToFile(folder.path("x_Images/own.jpg")));
  fs::create_symlink("../other/secret.jpg", folder.path("x_Images/link.jpg"));
  fs::create_directory_symlink(folder.path("other"), folder.path("x_Images/linked"));
  const auto named = [&](const std::string& name)
  {
    auto scan = sampleScan(kStart);
    scan->intensityImage.setExternalStorage(name);
    return writeObjects(folder.path("x.rawlog"), {scan});
  };
  EXPECT_EQ(readAll(named("own.jpg")).size(), 1u);
  RawlogSourceOptions anywhere;
  anywhere.imagesAnywhere = true;
  for (const std::string& name :
       {std::string("../other/secret.jpg"), folder.path("other/secret.jpg"),
        std::string("link.jpg"), std::string("linked/secret.jpg")})
  {
    SCOPED_TRACE(name);
    const auto file = named(name);
    expectProblem(file, {"x.rawlog: record 0 (camera): ", name, "lies outside"}, 0);
    EXPECT_EQ(readAll(file, anywhere).size(), 1u);
  }
  const auto withZero = named(std::string("own.jpg\0x", 9));
  expectProblem(withZero, {"external image own.jpg?x has a zero byte in its name"}, 0);
}

TEST(RawlogErrors, AnImageFolderThatIsALinkOutOfTheRawlogsFolderIsRefused)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  fs::create_directories(folder.path("given"));
  fs::create_directory(folder.path("other"));
  ASSERT_TRUE(sampleScan(kStart)->intensityImage.saveToFile(folder.path("other/secret.jpg")));
  fs::create_directory_symlink("../other", folder.path("given/x_Images"));
  auto scan = sampleScan(kStart);
  scan->intensityImage.setExternalStorage("secret.jpg");
  const auto file = writeObjects(folder.path("given/x.rawlog"), {scan});
  expectProblem(
      file, {"x.rawlog: record 0 (camera): ", "secret.jpg lies outside " + folder.path("given")},
      0);

  RawlogSourceOptions anywhere;
  anywhere.imagesAnywhere = true;
  EXPECT_EQ(readAll(file, anywhere).size(), 1u);

  fs::create_directory_symlink("given", folder.path("link"));
  fs::remove(folder.path("given/x_Images"));
  fs::rename(folder.path("other"), folder.path("given/pictures"));
  fs::create_directory_symlink("pictures", folder.path("given/x_Images"));
  EXPECT_EQ(readAll(folder.path("link/x.rawlog")).size(), 1u) << "both links stay inside";
}

TEST(RawlogErrors, OnlyWhereAUserCanAllowImagesAnywhereTheMessageSaysHow)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  folder.write("secret.jpg", "");
  fs::create_directory(folder.path("x_Images"));
  auto scan = sampleScan(kStart);
  scan->intensityImage.setExternalStorage("../secret.jpg");
  const auto file = writeObjects(folder.path("x.rawlog"), {scan});
  RawlogSourceOptions options;
  EXPECT_EQ(errorOf([&] { readAll(file, options); }).find("would allow"), std::string::npos);
  options.imagesHint = "--images-anywhere";
  const auto error = errorOf([&] { readAll(file, options); });
  EXPECT_NE(error.find("(--images-anywhere would allow that)"), std::string::npos) << error;
}

TEST(RawlogErrors, WaitingImagesTakeLimitedMemory)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.rawlog");
  constexpr std::size_t kScans = 15;
  const auto scan = sampleScan(kStart);
  scan->rangeImageOtherLayers["second"].resize(4096, 4000);  // 33 MB, and 12 of them 400 MB
  scan->rangeImageOtherLayers["second"].fill(0);
  {
    mrpt::io::CFileGZOutputStream file(path, mrpt::io::OpenMode::TRUNCATE, 1);
    auto archive = mrpt::serialization::archiveFrom(file);
    for (std::size_t i = 0; i < kScans; ++i)
    {
      scan->timestamp = stamp(kStart + 0.001 * static_cast<double>(i));
      archive << *scan;
    }
  }
  RawlogSource source(path, {});
  ASSERT_TRUE(source.next());
  EXPECT_LT(source.recordsRead(), kScans)
      << "there are no poses that the first scan could wait for";
}
