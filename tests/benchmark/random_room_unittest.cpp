#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

// Perception must not count on the noise of one camera. The room has a stereo camera, whose noise
// is none of its constants, and is measured with twice that; everything else is the same.
TEST(RandomRoom, TwiceTheNoiseOfDepthKeepsF1)
{
  constexpr int kSeed = 9;
  const double usual = f1OfRoom(kSeed, 1), twice = f1OfRoom(kSeed, 2);
  EXPECT_GE(usual, 0.85);
  EXPECT_GE(twice, usual - 0.05) << "one object of thirteen, and a bit";
}

}  // namespace
