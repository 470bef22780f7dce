#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "RunProgram.h"
#include "quadmap/obs/ObjectList.h"

using namespace quadmap;
using nlohmann::json;

namespace
{
/** A short way through the home, with boxes that may say which object they show. */
class QuadmapSlamAssociation : public ::testing::Test
{
 protected:
  void simulate(const std::string& options) const
  {
    const auto result = runProgram(
        "quadmap-simulate",
        "home --frames 40 --resolution 160x120 -o " + folder_.path("x.rawlog") + " " + options);
    ASSERT_EQ(result.status, 0) << result.err;
  }

  ProgramResult run(const std::string& options) const
  {
    return runProgram(
        "quadmap-slam", folder_.path("x.rawlog") + " -o " + folder_.path("out") +
                            " --every 1 --odometry ground-truth " + options);
  }

  void expectObjectsOfTheHome() const
  {
    constexpr double kNear = 0.5;  // [m]: centres of what is seen from one side are off
    const auto found = readObjectsJson(folder_.path("out/objects.json"));
    auto left = readObjectsJson(folder_.path("x.objects.gt.json"));
    EXPECT_GE(found.size() + 3, left.size()) << "some are hardly seen";
    for (const auto& object : found)
    {
      const auto match = std::find_if(
          left.begin(), left.end(),
          [&](const auto& truth)
          {
            return truth.label == object.label &&
                   (truth.object.center() - object.object.center()).norm() < kNear;
          });
      ASSERT_NE(match, left.end()) << object.label;
      left.erase(match);
    }
  }

  /** Only an object of the map can have been started. \return Boxes of objects of the map. */
  std::size_t boxesOfTheMap() const
  {
    std::size_t n = 0;
    const auto report = json::parse(readFile(folder_.path("out/report.json")));
    for (const auto& keyframe : report["associations"])
      for (const auto& box : keyframe["boxes"])
      {
        n += !box["object"].is_null();
        EXPECT_FALSE(box["object"].is_null() && box.value("started_object", false)) << box;
      }
    return n;
  }

  TemporaryFolder folder_;
};
}  // namespace

TEST_F(QuadmapSlamAssociation, PointsFindTheObjectsThemselves)
{
  simulate("");
  const auto result = run("--method point");
  ASSERT_EQ(result.status, 0) << result.err;
  expectObjectsOfTheHome();
  EXPECT_GT(boxesOfTheMap(), 50u);

  const auto strict = folder_.write("x.ini", "[point]\nminObservations=1000\n");
  ASSERT_EQ(run("--method point -c " + strict).status, 0);
  EXPECT_EQ(boxesOfTheMap(), 0u) << "what is not confirmed was not started";
}

TEST_F(QuadmapSlamAssociation, GivenAssociationsAreUsed)
{
  simulate("--instance-ids");
  for (const auto* method : {"point", "rgbd"})
  {
    const auto result = run(std::string("--association given --method ") + method);
    ASSERT_EQ(result.status, 0) << result.err;
    expectObjectsOfTheHome();
    EXPECT_GT(boxesOfTheMap(), 50u);
  }
}

TEST_F(QuadmapSlamAssociation, GivenAssociationsNeedInstanceIds)
{
  simulate("");
  const auto result = run("--association given --method point");
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("boxes has an instance id"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
}
