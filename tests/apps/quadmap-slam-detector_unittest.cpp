#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "RedCorner.h"
#include "RunProgram.h"

using namespace quadmap;
using nlohmann::json;

namespace
{
constexpr int kSeenFrames = 12;

class SlamWithDetector : public ::testing::Test
{
 protected:
  SlamWithDetector() : rawlog_(write("x.rawlog", redCornerScans(kSeenFrames))) {}

  /** Writes scans with odometry of a robot that goes forward. */
  std::string write(
      const std::string& name,
      const std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>& scans) const
  {
    std::vector<mrpt::serialization::CSerializable::Ptr> records;
    for (const auto& scan : scans)
    {
      const double time = mrpt::Clock::toDouble(scan->timestamp);
      records.push_back(samplePose(time, {0.5 * (time - kStart), 0, 0, 0, 0, 0}));
      records.push_back(scan);
    }
    return writeObjects(folder_.path(name), records);
  }
  ProgramResult run(const std::string& out, const std::string& arguments = "") const
  {
    return runProgram(
        "quadmap-slam", rawlog_ + " --every 1 -o " + folder_.path(out) + " " + arguments);
  }
  std::string detector() const { return "--detector '" + tiny_.model() + "' "; }

  json report(const std::string& out) const
  {
    return json::parse(readFile(folder_.path(out + "/report.json")));
  }
  std::string file(const std::string& name) const { return readFile(folder_.path(name)); }

  TinyDetector tiny_;
  TemporaryFolder folder_;
  std::string rawlog_;
};
}  // namespace

TEST_F(SlamWithDetector, FindsTheBoxesOfTheKeyframes)
{
  const auto result = run("out", detector());
  ASSERT_EQ(result.status, 0) << result.err;
  const json r = report("out");
  EXPECT_EQ(r["input"]["keyframes"], kSeenFrames);
  EXPECT_EQ(r["input"]["keyframes_without_boxes"], 0);
  EXPECT_EQ(r["input"]["boxes"], kSeenFrames);
  EXPECT_TRUE(r["boxes"]["by_label"].contains("chair"));
  EXPECT_EQ(r["configuration"]["slam"]["detector"], tiny_.model());
  EXPECT_EQ(r["timing"]["modules"]["detection"]["calls"], kSeenFrames);
}

TEST_F(SlamWithDetector, GivesTheSameWithAnyNumberOfThreads)
{
  for (const char* threads : {"1", "2", "5"})
    ASSERT_EQ(run(std::string("out") + threads, detector() + "--threads " + threads).status, 0);
  for (const char* name :
       {"objects.quadmap", "objects.json", "objects.simplemap", "trajectory.tum", "map.simplemap"})
    for (const char* threads : {"2", "5"})
      EXPECT_EQ(file(std::string("out") + threads + "/" + name), file(std::string("out1/") + name));
}

TEST_F(SlamWithDetector, GivesTheSameAsBoxesThatWereFoundBefore)
{
  ASSERT_EQ(run("own", detector()).status, 0);
  ASSERT_EQ(runProgram("quadmap-detect", rawlog_ + " --model '" + tiny_.model() + "'").status, 0);
  ASSERT_EQ(run("before").status, 0);
  for (const char* name : {"objects.quadmap", "objects.simplemap", "trajectory.tum"})
    EXPECT_EQ(file(std::string("own/") + name), file(std::string("before/") + name)) << name;
}

TEST_F(SlamWithDetector, IgnoresTheBoxesOfTheInput)
{
  folder_.write("x.objects.rawlog", "nonsense");
  EXPECT_EQ(run("out").status, 1);
  const auto result = run("out", detector());
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(SlamWithDetector, NeedsColour)
{
  auto scans = redCornerScans(kSeenFrames);
  for (std::size_t i = 0; i < 5; ++i) scans[i]->hasIntensityImage = false;
  rawlog_ = write("x.rawlog", scans);
  ASSERT_EQ(run("out", detector()).status, 0);
  EXPECT_EQ(report("out")["input"]["keyframes_without_boxes"], 5);
  for (const auto& scan : scans) scan->hasIntensityImage = false;
  rawlog_ = write("x.rawlog", scans);
  const auto result = run("none", detector());
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("none of its images has colour"), kNotFound) << result.err;
}

TEST_F(SlamWithDetector, NamesTheModelThatCannotBeUsed)
{
  const auto expectError = [&](const std::string& arguments, int status, const std::string& part)
  {
    const auto result = run("out", arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(part), kNotFound) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out"))) << "nothing is left behind";
  };
  expectError("--detector nosuch", 1, "nosuch: is no known model");
  expectError("--detector chairs.onnx", 1, "chairs.onnx: there is no such file");
  expectError("--objects x " + detector(), 2, "--objects: not with a detector");
  tiny_.folder.write("tiny.weights", "");
  expectError(detector(), 1, "tiny.weights: is empty");
}
