// Tests that a map which is continued again and again knows how well it is known.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "MappedRoom.h"

using namespace quadmap;

TEST(ManySessions, ClaimNoMoreThanTheyErr)
{
  const TemporaryFolder folder;
  std::string earlier;
  for (int session = 1; session <= 10; ++session)
  {
    const std::string name = folder.path(std::to_string(session));
    mapRoom(
        name, "home --resolution 160x120 --frames 40 --seed " + std::to_string(session),
        earlier.empty() ? "" : "--map " + earlier);
    if (HasFatalFailure()) return;
    earlier = name;
  }
  const auto evaluated = runProgram(
      "quadmap-evaluate", earlier + " --objects " + earlier + ".objects.gt.json --trajectory " +
                              earlier + ".groundtruth.tum --json " + folder.path("e.json"));
  ASSERT_EQ(evaluated.status, 0) << evaluated.err;
  const auto objects = nlohmann::json::parse(readFile(folder.path("e.json")))["objects"];
  EXPECT_EQ(objects["matched"], objects["truth"]);
  // Sessions that counted what they were told as something new would claim a third of their errors.
  EXPECT_LT(objects["nees_center"].get<double>(), 3)
      << "squared errors of centres, by their covariance";
}
