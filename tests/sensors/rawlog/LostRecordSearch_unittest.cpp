#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>

#include <chrono>

#include "LostRecords.h"

using namespace quadmap;

// What files cost that were made to be searched for long.
// Each beginning of a record states a size that takes all bytes behind it.
TEST(LostRecordSearch, EndsWhereRecordsTakeAllBytesBehindThem)
{
  const TemporaryFolder folder;
  const std::string rays = readFile(withRays(folder, 900000));
  const auto from = rays.find("mrpt::obs::CObservation2DRangeScan") - 1;
  const auto to = rays.find(bytesOf(900000)) + sizeof(std::uint32_t);
  const std::string beginning = rays.substr(from, to - from);
  std::string bytes;
  while (bytes.size() < (1u << 23)) bytes += beginning;
  const auto begin = std::chrono::steady_clock::now();
  RawlogSource source(folder.write("x.rawlog", bytes), keepGoing());
  EXPECT_TRUE(readAll(source).empty());
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20))
      << "0.4 s with the bound";
}

// MRPT takes the memory that such a text states before it reads it: for 256 MB, 0.1 s for 49 bytes
// of a file. It states less here, as the memory guard leaves sanitizers no room for that.
TEST(LostRecordSearch, TriesNothingThatMrptReadsByItself)
{
  const TemporaryFolder folder;
  constexpr std::uint32_t kLetters = 77;
  auto comment = mrpt::obs::CObservationComment::Create();
  comment->text = std::string(kLetters, 'x');
  const std::string whole = readFile(writeObjects(folder.path("c"), {comment}, false));
  const std::string beginning = whole.substr(0, whole.find(bytesOf(kLetters))) + bytesOf(1u << 24);
  ASSERT_LT(beginning.size(), 60u);
  std::string bytes;
  while (bytes.size() < (1u << 20)) bytes += beginning;
  int asked = 0;
  RawlogSourceOptions options = keepGoing();
  options.shouldStop = [&] { return ++asked < 0; };
  const std::string last = readFile(writeObjects(folder.path("s"), {sampleScan(kStart)}, false));
  RawlogSource source(folder.write("x.rawlog", bytes + last), options);
  EXPECT_EQ(readAll(source).size(), 1u) << "it is within 64 MB, and nothing before it was tried";
  EXPECT_LT(asked, 20) << "each try that failed asks whether to stop";
}

TEST(LostRecordSearch, TriesNoMoreThanSoManyTimesAndMayBeStopped)
{
  const TemporaryFolder folder;
  const std::string rays = readFile(withRays(folder, 0xffffffffu));
  const auto from = rays.find("mrpt::obs::CObservation2DRangeScan") - 1;
  const std::string beginning = rays.substr(from, rays.find(bytesOf(0xffffffffu)) + 4 - from);
  std::string bytes;
  for (int i = 0; i < 40000; ++i) bytes += beginning;
  const std::string last = readFile(writeObjects(folder.path("s"), {sampleScan(kStart)}, false));
  const auto file = folder.write("x.rawlog", bytes + last);
  int asked = 0;
  RawlogSourceOptions options = keepGoing();
  options.shouldStop = [&] { return ++asked < 0; };
  RawlogSource source(file, options);
  EXPECT_TRUE(readAll(source).empty());
  EXPECT_LT(asked, 17000);

  asked = 0;
  options.shouldStop = [&] { return ++asked == 100; };
  RawlogSource stopped(file, options);
  EXPECT_TRUE(readAll(stopped).empty());
  EXPECT_TRUE(stopped.wasStopped());
  EXPECT_EQ(asked, 100);
}
