#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "../apps/RunProgram.h"

using namespace quadmap;

namespace
{
/** Maps a random room on drifting odometry through all programs: `out` and `out.json` in the
 * folder. \param noise Factor of the errors of depth. */
bool mapRoom(const TemporaryFolder& folder, int seed, double noise)
{
  const auto run = [](const std::string& program, const std::string& arguments)
  {
    const auto result = runProgram(program, arguments);
    EXPECT_EQ(result.status, 0) << program << " " << arguments << "\n" << result.err;
    return result.status == 0;
  };
  const std::string rawlog = folder.path("x.rawlog"), out = folder.path("out");
  return run("quadmap-simulate", "random --seed " + std::to_string(seed) +
                                     " --resolution 320x240 --frames 80 --depth-noise " +
                                     std::to_string(noise) + " -o " + rawlog) &&
         run("quadmap-slam", rawlog + " -o " + out + " -v warn") &&
         run("quadmap-evaluate", out + " --objects " + folder.path("x.objects.gt.json") +
                                     " --trajectory " + folder.path("x.groundtruth.tum") +
                                     " --json " + out + ".json");
}

double f1OfRoom(int seed, double noise)
{
  const TemporaryFolder folder;
  if (!mapRoom(folder, seed, noise)) return -1;
  return nlohmann::json::parse(readFile(folder.path("out.json")))["objects"]["f1"];
}

// Perception must not count on the noise of one camera: with twice the noise of the room's sensor
// it loses things that are far or thin, but not the room. Wanted is to lose none. Over these rooms
// F1 falls from .98 to .93.
TEST(RandomRoom, TwiceTheNoiseOfDepthCostsFewObjects)
{
  double usual = 0, twice = 0;
  const std::vector<int> seeds = {2, 5, 9, 12};
  for (const int seed : seeds)
  {
    usual += f1OfRoom(seed, 1) / static_cast<double>(seeds.size());
    twice += f1OfRoom(seed, 2) / static_cast<double>(seeds.size());
  }
  EXPECT_GE(usual, 0.93);
  EXPECT_GE(twice, usual - 0.075) << "two objects of twenty-seven";
}

TEST(RandomRoom, ExistenceAndSizesAreComparedWithTheTruth)
{
  const TemporaryFolder folder;
  ASSERT_TRUE(mapRoom(folder, 2, 1));
  const auto result = runCommand(
      "python3 " QUADMAP_SOURCE_DIR "/tests/benchmark/existence.py " + folder.path("out"));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("sizes of true objects are off by"), kNotFound) << result.out;
}

}  // namespace
