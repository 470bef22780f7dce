#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <random>

#include "RawlogProblems.h"
#include "quadmap/sensors/RawlogWriter.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
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
      2);
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

TEST(RawlogErrors, WaitingImagesTakeLimitedMemory)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.rawlog");
  constexpr std::size_t kScans = 15;
  const auto scan = sampleScan(kStart);
  auto& layer = scan->rangeImageOtherLayers["second"];
  layer.resize(4096, 4000);  // 33 MB, and 12 of them 400 MB
  layer.fill(0);
  // A file of so much must not be too small for it.
  std::mt19937 random(1);
  for (int i = 0; i < layer.rows(); i += 16)
    for (int j = 0; j < layer.cols(); ++j) layer(i, j) = static_cast<std::uint16_t>(random());
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
