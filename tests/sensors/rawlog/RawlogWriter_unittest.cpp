#include "quadmap/sensors/RawlogWriter.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CRawlog.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "../SampleRawlog.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
constexpr int kFrames = 3;

std::string unpacked(const std::string& path)
{
  const gzFile file = gzopen(path.c_str(), "rb");
  std::string content(1 << 20, '\0');
  content.resize(static_cast<std::size_t>(
      std::max(0, gzread(file, content.data(), static_cast<unsigned>(content.size())))));
  gzclose(file);
  return content;
}

void writeSample(const std::string& file, RawlogWriterOptions options = {}, bool boxes = true)
{
  RawlogWriter writer(file, options);
  for (int i = 0; i < kFrames; ++i)
  {
    const double time = kStart + i;
    writer.writePose(stamp(time), kOdometryLabel, CPose3D(i, 0, 0, 0.1 * i, 0, 0));
    writer.write(*sampleScan(time));
    if (boxes) writer.write(*sampleBoxes(time));
  }
  writer.finish();
}

void expectSampleIn(const std::string& file)
{
  const auto frames = readAll(file);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i)
  {
    const auto& frame = frames[static_cast<std::size_t>(i)];
    const auto expected = sampleScan(kStart + i);
    EXPECT_EQ(frame.scan->timestamp, expected->timestamp);
    EXPECT_TRUE(frame.scan->rangeImage == expected->rangeImage);
    EXPECT_FLOAT_EQ(frame.scan->rangeUnits, 0.001f);
    ASSERT_TRUE(frame.T_odom_robot);
    EXPECT_DOUBLE_EQ(frame.T_odom_robot->x(), i);
    ASSERT_TRUE(frame.objects);
    EXPECT_EQ(frame.objects->objects[1].label, "cup");
    EXPECT_DOUBLE_EQ(frame.objects->objects[1].box.x1, -3.0);
    const auto& image = frame.scan->intensityImage;
    ASSERT_EQ(image.getWidth(), static_cast<std::size_t>(kColumns));
    for (int u = 0; u < kColumns; ++u)
      EXPECT_NEAR(image.at<std::uint8_t>(u, 9, 1), 4 * u, 4) << "JPEG at 95";
  }
}

std::string errorOnFullDisk(const std::string& file, RawlogWriterOptions options)
{
  const FileSizeLimit full(500);
  return errorOf([&] { writeSample(file, options); });
}
}  // namespace

TEST(RawlogWriter, WritesWhatIsReadBack)
{
  const TemporaryFolder folder;
  writeSample(folder.path("x.rawlog"));
  EXPECT_EQ(folder.fileCount(), 2u) << "the rawlog and its boxes, nothing else";
  expectSampleIn(folder.path("x.rawlog"));
}

TEST(RawlogWriter, ExternalImagesAreReadBack)
{
  const TemporaryFolder folder;
  RawlogWriterOptions options;
  options.external = true;
  writeSample(folder.path("x.rawlog"), options);
  EXPECT_EQ(folder.fileCount(), 3u);
  EXPECT_TRUE(std::filesystem::exists(folder.path("x_Images/camera_000002.jpg")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("x_Images/camera_000002_depth.bin")));
  expectSampleIn(folder.path("x.rawlog"));
}

TEST(RawlogWriter, StockReadersReadTheRawlog)
{
  const TemporaryFolder folder;
  writeSample(folder.path("x.rawlog"));
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(folder.path("x.rawlog")));
  EXPECT_EQ(rawlog.size(), 2u * kFrames);
}

TEST(RawlogWriter, WritesAJpegAsItIs)
{
  const TemporaryFolder folder;
  const auto sample = sampleScan(kStart);
  cv::imwrite(folder.path("image.jpg"), sample->intensityImage.asCvMatRef());
  const std::string jpeg = readFile(folder.path("image.jpg"));
  for (const bool external : {false, true})
  {
    const std::string file = folder.path(external ? "e.rawlog" : "x.rawlog");
    RawlogWriterOptions options;
    options.external = external;
    RawlogWriter writer(file, options);
    for (int i = 0; i < kFrames; ++i)
    {
      auto scan = sampleScan(kStart + i);
      scan->intensityImage = mrpt::img::CImage();
      writer.write(*scan, std::vector<std::uint8_t>(jpeg.begin(), jpeg.end()));
    }
    writer.finish();
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile(file));
    ASSERT_EQ(rawlog.size(), std::size_t{kFrames});
    if (external)
    {
      EXPECT_EQ(readFile(folder.path("e_Images/camera_000002.jpg")), jpeg);
      continue;
    }
    const auto frames = readAll(file);
    ASSERT_EQ(frames.size(), std::size_t{kFrames});
    const cv::Mat decoded = cv::imread(folder.path("image.jpg"));
    for (const auto& frame : frames)
    {
      const cv::Mat image = frame.scan->intensityImage.asCvMatRef();
      EXPECT_EQ(cv::norm(image, decoded, cv::NORM_INF), 0) << "no second loss";
      EXPECT_EQ(frame.scan->rangeImage, sample->rangeImage);
    }
    EXPECT_NE(unpacked(file).find(jpeg), std::string::npos);
    EXPECT_NE(readFile(file).find(jpeg), std::string::npos) << "stored, as it gets no smaller";
  }
}

TEST(RawlogWriter, SameInputGivesTheSameBytes)
{
  const TemporaryFolder folder;
  for (const bool external : {false, true})
  {
    RawlogWriterOptions options;
    options.external = external;
    const std::string a = external ? "a.rawlog" : "c.rawlog",
                      b = external ? "b.rawlog" : "d.rawlog";
    writeSample(folder.path(a), options);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // another second for time stamps
    writeSample(folder.path(b), options);
    EXPECT_EQ(readFile(folder.path(a)), readFile(folder.path(b)));
    EXPECT_EQ(readFile(objectsFileOf(folder.path(a))), readFile(objectsFileOf(folder.path(b))));
  }
  for (const char* name : {"camera_000001.jpg", "camera_000001_depth.bin"})
    EXPECT_EQ(readFile(folder.path("a_Images/") + name), readFile(folder.path("b_Images/") + name));
}

TEST(RawlogWriter, LeavesNothingWithoutFinish)
{
  const TemporaryFolder folder;
  {
    RawlogWriterOptions options;
    options.external = true;
    RawlogWriter writer(folder.path("x.rawlog"), options);
    writer.write(*sampleScan(kStart));
    writer.write(*sampleBoxes(kStart));
  }
  EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(RawlogWriter, RemovesOlderBoxesThatWouldBePickedUp)
{
  const TemporaryFolder folder;
  writeSample(folder.path("x.rawlog"));
  writeSample(folder.path("x.rawlog"), {}, false);
  EXPECT_EQ(folder.fileCount(), 1u);
  EXPECT_FALSE(readAll(folder.path("x.rawlog")).at(0).objects);
}

TEST(RawlogWriter, DoesNotTouchAnExistingImagesFolder)
{
  const TemporaryFolder folder;
  RawlogWriterOptions options;
  options.external = true;
  writeSample(folder.path("x.rawlog"), options);
  const std::string error = errorOf([&] { writeSample(folder.path("x.rawlog"), options); });
  EXPECT_NE(error.find("x_Images: exists already"), std::string::npos) << error;
  expectSampleIn(folder.path("x.rawlog"));
}

TEST(RawlogWriter, KeepsTheOldFileWhenTheDiskIsFull)
{
  const TemporaryFolder folder;
  const auto file = folder.write("x.rawlog", "old");
  for (const bool external : {false, true})
  {
    RawlogWriterOptions options;
    options.external = external;
    const std::string error = errorOnFullDisk(file, options);
    EXPECT_NE(error.find(external ? "x_Images/camera_" : "x.rawlog: "), std::string::npos) << error;
    EXPECT_NE(error.find(": cannot be written: File too large"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    EXPECT_EQ(readFile(file), "old");
    EXPECT_EQ(folder.fileCount(), 1u) << "no temporary file stays";
  }
}

TEST(RawlogWriter, TellsWhyAnImageCannotBeWritten)
{
  const TemporaryFolder folder;
  RawlogWriterOptions options;
  options.external = true;
  const std::vector<std::uint8_t> jpeg(5000);
  for (const bool isEncoded : {false, true})
  {
    RawlogWriter writer(folder.path("x.rawlog"), options);
    const auto scan = sampleScan(kStart);
    scan->hasRangeImage = false;
    const auto write = [&] { isEncoded ? writer.write(*scan, jpeg) : writer.write(*scan); };
    std::string error;
    {
      const FileSizeLimit full(500);
      error = errorOf(write);
    }
    EXPECT_EQ(
        error, folder.path("x_Images/camera_000000.jpg") + ": cannot be written: File too large");
  }
}

TEST(RawlogWriter, ReportsADiskThatIsFullAtTheLastByteOnly)
{
  const TemporaryFolder folder;
  // One pose: everything is still in memory when the file is closed.
  std::string error;
  {
    const FileSizeLimit full(20);
    error = errorOf(
        [&]
        {
          RawlogWriter writer(folder.path("x.rawlog"), {});
          writer.writePose(stamp(kStart), kOdometryLabel, CPose3D());
          writer.finish();
        });
  }
  EXPECT_NE(error.find("x.rawlog: cannot be written: "), std::string::npos) << error;
  EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(RawlogWriter, RefusesFoldersThatAreNotThere)
{
  const TemporaryFolder folder;
  const auto file = folder.path("no/x.rawlog");
  const std::string error = errorOf([&] { RawlogWriter(file, {}); });
  EXPECT_NE(error.find(file), std::string::npos) << error;
}

TEST(RawlogWriter, RefusesOptionsOutOfRange)
{
  const TemporaryFolder folder;
  RawlogWriterOptions level, quality;
  level.compressionLevel = 10;
  quality.jpegQuality = 0;
  EXPECT_THROW(RawlogWriter(folder.path("x.rawlog"), level), std::invalid_argument);
  EXPECT_THROW(RawlogWriter(folder.path("x.rawlog"), quality), std::invalid_argument);
}

TEST(RawlogWriter, EveryLevelIsReadBack)
{
  const TemporaryFolder folder;
  for (const int level : {0, 6, 9})
  {
    RawlogWriterOptions options;
    options.compressionLevel = level;
    writeSample(folder.path("x.rawlog"), options);
    expectSampleIn(folder.path("x.rawlog"));
  }
}

TEST(RawlogWriter, LeavesTheGlobalJpegSettingsAlone)
{
  const TemporaryFolder folder;
  using mrpt::img::CImage;
  const bool disabled = CImage::DISABLE_JPEG_COMPRESSION();
  const int quality = CImage::SERIALIZATION_JPEG_QUALITY();
  RawlogWriterOptions options;
  options.jpegQuality = 31;
  writeSample(folder.path("x.rawlog"), options);
  EXPECT_EQ(CImage::DISABLE_JPEG_COMPRESSION(), disabled);
  EXPECT_EQ(CImage::SERIALIZATION_JPEG_QUALITY(), quality);
}
