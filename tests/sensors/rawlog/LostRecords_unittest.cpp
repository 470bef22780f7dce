#include "LostRecords.h"

#include <gtest/gtest.h>
#include <zlib.h>

using namespace quadmap;

// Behind a record that cannot be read the next one is looked for.
namespace
{
/** Expects that the laser scan alone is lost. */
void expectOneLost(const std::string& file)
{
  expectProblem(file, {"x.rawlog: record 1: ", "CObservation2DRangeScan"}, 2);
  RawlogSource source(file, keepGoing());
  readAll(source);
  EXPECT_EQ(
      source.contentSummary(), "2 CObservation3DRangeScan \"camera\", 1 CObservationRobotPose");
  EXPECT_EQ(source.problems().size(), 1u);
}
}  // namespace

TEST(LostRecords, ACountThatIsTooSmallCostsItsRecord)
{
  const TemporaryFolder folder;
  expectOneLost(withRays(folder, 3));
}

// It takes the bytes of the records behind for rays, or those of the whole file.
TEST(LostRecords, ACountThatIsTooLargeCostsItsRecord)
{
  const TemporaryFolder folder;
  for (const std::uint32_t count : {kRays + 10, kRays + 500, 100000u, 0xffffffffu})
  {
    SCOPED_TRACE(count);
    expectOneLost(withRays(folder, count));
  }
}

// MRPT makes room for so many numbers before it reads any.
TEST(LostRecords, ACountOfAnUnknownClassCostsItsRecord)
{
#ifdef QUADMAP_SANITIZED
  GTEST_SKIP() << "sanitizers end the program when memory is refused";
#endif
  const TemporaryFolder folder;
  const auto scanAt = [&](double time)
  { return readFile(writeObjects(folder.path("scan"), {sampleScan(time)}, false)); };
  const std::string name = "mrpt::obs::CObservationBatteryState";
  const std::string battery = static_cast<char>(0x80 | name.size()) + name + '\x02' +
                              std::string(18, '\0') + bytesOf(40000000u) + std::string(64, '\0');
  folder.write("x.rawlog", scanAt(kStart) + battery + scanAt(kStart + 1));
  expectProblem(
      folder.path("x.rawlog"), {"x.rawlog: record 1: ", name, "sizes that take too much memory"},
      2);
}

TEST(LostRecords, TheirBytesMayLookLikeARecord)
{
  const TemporaryFolder folder;
  std::string bytes = readFile(withRays(folder, 0xffffffffu));
  const std::string posed =
      readFile(writeObjects(folder.path("p"), {samplePose(kStart, {})}, false));
  const std::string head = posed.substr(0, posed.find("CObservationRobotPose") + 21);
  const auto ranges = bytes.find(bytesOf(0xffffffffu)) + 100;
  expectOneLost(folder.write("x.rawlog", bytes.replace(ranges, head.size(), head)));
}

TEST(LostRecords, EndTheFileWhenNothingIsBehindThem)
{
  const TemporaryFolder folder;
  const std::string bytes = recordedBytes(folder);
  const std::string cut = bytes.substr(0, bytes.find("CObservation2DRangeScan") + 100);
  expectProblem(folder.write("x.rawlog", cut), {"x.rawlog: record 1: ", "truncated"}, 1);
  RawlogSource source(folder.path("x.rawlog"), keepGoing());
  readAll(source);
  EXPECT_EQ(source.problems().size(), 1u);
}

/** The file compressed, without its last bytes. */
std::string cutGz(const TemporaryFolder& folder, const std::string& bytes, std::size_t lack)
{
  const auto whole = folder.path("whole.gz");
  const gzFile gz = gzopen(whole.c_str(), "wb");
  EXPECT_EQ(gzwrite(gz, bytes.data(), static_cast<unsigned>(bytes.size())), int(bytes.size()));
  gzclose(gz);
  const std::string packed = readFile(whole);
  return folder.write("gz.rawlog", packed.substr(0, packed.size() - lack));
}

// The search reads ahead, and meets the cut while records are left before it.
TEST(LostRecords, CostNoOthersBeforeTheCutOfACompressedFile)
{
  const TemporaryFolder folder;
  const std::string bytes = readFile(withRays(folder, 3));
  const auto plain = folder.write("x.rawlog", bytes.substr(0, bytes.size() - 1));
  for (const std::size_t lack : {std::size_t{1}, std::size_t{8}, std::size_t{20}})
  {
    RawlogSource cut(plain, keepGoing()), cutPacked(cutGz(folder, bytes, lack), keepGoing());
    EXPECT_EQ(readAll(cut).size(), 2u);
    EXPECT_EQ(readAll(cutPacked).size(), 2u) << lack;
    EXPECT_NE(cutPacked.problems().back().what.find("truncated"), std::string::npos) << lack;
  }
}

TEST(LostRecords, OfTheSidecarCostNoOthers)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"),
      {sampleScan(kStart), sampleScan(kStart + 1), sampleScan(kStart + 2)});
  const auto sidecar = folder.path("x.objects.rawlog");
  std::string bytes = readFile(writeObjects(
      sidecar, {sampleBoxes(kStart), sampleBoxes(kStart + 1), sampleBoxes(kStart + 2)}, false));
  const std::string name = "CObservationObjects";
  const auto second = bytes.find(name, bytes.find(name) + 1);
  ASSERT_LT(second, bytes.size());
  bytes[second + name.size()] = 99;  // its version
  folder.write("x.objects.rawlog", bytes);
  RawlogSource source(file, keepGoing());
  const auto frames = readAll(source);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_TRUE(frames[0].objects);
  EXPECT_FALSE(frames[1].objects);
  EXPECT_TRUE(frames[2].objects);
}

// The survey of the sidecar has to see how far its times go back, behind what is broken, too.
TEST(LostRecords, OfASidecarOfSensorsOneAfterTheOtherCostNoOthers)
{
  const TemporaryFolder folder;
  constexpr int kImages = 8;
  std::vector<mrpt::serialization::CSerializable::Ptr> scans, boxes;
  for (int i = 0; i < kImages; ++i)
    for (const char* label : {"a", "b"}) scans.push_back(sampleScan(kStart + i, label));
  for (const char* label : {"a", "b"})
    for (int i = 0; i < kImages; ++i) boxes.push_back(sampleBoxes(kStart + i, label));
  std::string bytes = readFile(writeObjects(folder.path("x.objects.rawlog"), boxes, false));
  const std::string name = "CObservationObjects";
  bytes[bytes.find(name) + name.size()] = 99;  // its version
  folder.write("x.objects.rawlog", bytes);
  const auto frames = readAll(writeObjects(folder.path("x.rawlog"), scans), keepGoing());
  ASSERT_EQ(frames.size(), 2u * kImages);
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(bool(frames[i].objects), i > 0) << i;
}

// Their bytes are not kept, but their name is said.
TEST(LostRecords, AreNamedWhenTheyAreLong)
{
  const TemporaryFolder folder;
  constexpr std::uint32_t kPoints = 12345, kMany = 7000000;
  const auto scan = sampleScan(kStart);
  scan->hasPoints3D = true;
  scan->resizePoints3DVectors(kPoints);
  const std::string whole = readFile(writeObjects(folder.path("s"), {scan}, false));
  std::string bytes = whole.substr(0, whole.find(bytesOf(kPoints))) + bytesOf(kMany);
  bytes.resize(bytes.size() + (70u << 20));
  expectProblem(
      cutGz(folder, bytes, 0),
      {"record 0: mrpt::obs::CObservation3DRangeScan: the file is truncated"}, 0);
}

namespace
{
std::vector<std::string> problemsOf(const std::string& file)
{
  RawlogSource source(file, keepGoing());
  readAll(source);
  std::vector<std::string> texts;
  for (const auto& problem : source.problems()) texts.push_back(problem.text());
  return texts;
}
}  // namespace

TEST(LostRecords, AreOneProblemAndAWarningOfTheirBytes)
{
  const TemporaryFolder folder;
  const auto file = withRays(folder, 3);
  EXPECT_EQ(problemsOf(file).size(), 1u);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  problemsOf(file);
  const std::string said =
      testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  const auto lost = readFile(writeObjects(folder.path("y"), {sampleRays(kStart)}, false)).size();
  EXPECT_NE(said.find(": " + std::to_string(lost) + " bytes were left out"), std::string::npos)
      << said;
}

// The observations of a frame are found, and its end is no record.
TEST(LostRecords, OfSeveralObservationsLeaveTheseBehind)
{
  const TemporaryFolder folder;
  const auto frame = mrpt::obs::CSensoryFrame::Create();
  for (const char* label : {"a", "b", "c"}) frame->insert(sampleScan(kStart, label));
  const auto last = sampleScan(kStart + 1, "a");
  for (const bool endsFile : {false, true})
  {
    std::vector<mrpt::serialization::CSerializable::Ptr> objects = {frame};
    if (!endsFile) objects.push_back(last);
    const std::string whole = readFile(writeObjects(folder.path("f"), objects, false));
    const std::string name = "CSensoryFrame", part = "CObservation3DRangeScan";
    std::string bytes = whole;
    bytes[bytes.find(name) + name.size()] = 99;  // its version
    const auto file = folder.write("x.rawlog", bytes);
    expectProblem(file, {"record 0: ", name}, endsFile ? 3 : 4);
    EXPECT_EQ(problemsOf(file).size(), 1u);

    bytes = whole;
    const auto second = bytes.find(part, bytes.find(part) + 1);
    bytes[second + part.size()] = 99;
    expectProblem(folder.write("x.rawlog", bytes), {"record 0: ", name}, endsFile ? 2 : 3);
    EXPECT_EQ(problemsOf(file).size(), 2u) << "the frame, and its second observation";
  }
}

TEST(LostRecords, DoNotHideTheDamagedImageBehindThem)
{
  const TemporaryFolder folder;
  std::string bytes = readFile(withRays(folder, 3));
  bytes.erase(bytes.rfind("mrpt::obs::CObservation3DRangeScan") - 1);
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
  bytes += readFile(writeObjects(
      folder.path("i"), {sampleScan(kStart + 1, "damaged"), sampleScan(kStart + 2)}, false));
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);
  bytes.replace(bytes.find("\xff\xda") + 14, 40, 40, '\0');  // the first pixels
  const auto problems = problemsOf(folder.write("x.rawlog", bytes));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_NE(problems[0].find("record 1: "), std::string::npos) << problems[0];
  EXPECT_NE(problems[1].find("record 2 (damaged): "), std::string::npos) << problems[1];
}
