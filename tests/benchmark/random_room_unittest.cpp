#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "../apps/RunProgram.h"

using namespace quadmap;

namespace
{
/** F1 of a random room that is mapped on drifting odometry through all programs.
 * \param noise Factor of the errors of depth. */
double f1OfRoom(int seed, double noise)
{
  const TemporaryFolder folder;
  const auto run = [](const std::string& program, const std::string& arguments)
  {
    const auto result = runProgram(program, arguments);
    EXPECT_EQ(result.status, 0) << program << " " << arguments << "\n" << result.err;
    return result.status == 0;
  };
  const std::string rawlog = folder.path("x.rawlog"), out = folder.path("out");
  const std::string figures = folder.path("figures.json");
  const bool done = run("quadmap-simulate", "random --seed " + std::to_string(seed) +
                                                " --resolution 320x240 --frames 80 --depth-noise " +
                                                std::to_string(noise) + " -o " + rawlog) &&
                    run("quadmap-slam", rawlog + " -o " + out + " -v warn") &&
                    run("quadmap-evaluate",
                        out + " --objects " + folder.path("x.objects.gt.json") + " --trajectory " +
                            folder.path("x.groundtruth.tum") + " --json " + figures);
  if (!done) return -1;
  return nlohmann::json::parse(readFile(figures))["objects"]["f1"];
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

}  // namespace
