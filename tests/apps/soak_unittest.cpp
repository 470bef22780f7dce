#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "RunProgram.h"

using namespace quadmap;

namespace
{
/** A row of the script's table. */
struct Sample
{
  int keyframes = 0;
  double memory_mb = 0;
};

std::vector<Sample> samplesOf(const std::string& table)
{
  std::vector<Sample> samples;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
  {
    Sample sample;
    if (std::sscanf(line.c_str(), "| %*s | %d | %lf |", &sample.keyframes, &sample.memory_mb) == 2)
      samples.push_back(sample);
  }
  return samples;
}
}  // namespace

TEST(Soak, MemoryStaysFlatAndKilledRunsLeaveWholeResults)
{
  constexpr int kFrames = 400;
  const auto result =
      runCommand(QUADMAP_SOURCE_DIR "/share/quadmap/benchmark/soak --bin " QUADMAP_BIN_DIR
                                    " --frames 400 --laps 2 --kills 3 --poses rawlog");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto samples = samplesOf(result.out);
  ASSERT_EQ(samples.size(), 20u) << result.out;
  EXPECT_EQ(samples.back().keyframes, kFrames) << "each image is a new view";
  // The first lap meets all objects. The second one has 200 keyframes, whose images have 19 MB.
  EXPECT_LT(samples.back().memory_mb, samples[9].memory_mb + 4) << result.out;
  EXPECT_NE(result.out.find("\n3 kills in runs of "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" 0 incomplete\n"), std::string::npos) << result.out;
}

TEST(Soak, RefusesWhatItCannotDo)
{
  const std::string soak = QUADMAP_SOURCE_DIR "/share/quadmap/benchmark/soak";
  EXPECT_EQ(runCommand(soak + " --frame 3").status, 2);
  const auto tooMuch = runCommand(soak + " --bin " QUADMAP_BIN_DIR " --frames 90000000000");
  EXPECT_EQ(tooMuch.status, 1);
  EXPECT_NE(tooMuch.err.find("MB free"), std::string::npos) << tooMuch.err;
}
