// Tests quadmap-localize in the map of an earlier walk through the same room, with other errors of
// all sensors.
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "../sensors/StopAfter.h"
#include "MappedRoom.h"
#include "OdometryRecords.h"
#include "quadmap/maps/MapFile.h"
#include "quadmap/navigation/LocalizationRun.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/sensors/RawlogNames.h"

using namespace quadmap;
using nlohmann::json;

namespace
{
class Localize : public ::testing::Test
{
 protected:
  static void SetUpTestSuite()
  {
    folder_ = new TemporaryFolder;
    const std::string scene = "home --frames 60 --resolution 240x180";
    ASSERT_NO_FATAL_FAILURE(mapRoom(path("first"), scene + " --seed 1"));
    ASSERT_EQ(
        runProgram("quadmap-simulate", scene + " --seed 2 -o " + path("second.rawlog")).status, 0);
  }
  static void TearDownTestSuite()
  {
    delete folder_;
    folder_ = nullptr;
  }

  static std::string path(const std::string& name) { return folder_->path(name); }

  static ProgramResult localize(const std::string& out, const std::string& options)
  {
    return runProgram(
        "quadmap-localize",
        path("second.rawlog") + " --map " + path("first") + " -o " + path(out) + " " + options);
  }

  static TemporaryFolder* folder_;
};
TemporaryFolder* Localize::folder_ = nullptr;
}  // namespace

TEST_F(Localize, FindsTheRobotFromAnywhereInTheMap)
{
  const Trajectory truth = readTumTrajectory(path("second.groundtruth.tum"));
  for (const std::string seed : {"1", "2"})
  {
    const auto result = localize("out" + seed, "--seed " + seed);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("localised from update"), std::string::npos) << result.out;
    const Trajectory found = readTumTrajectory(path("out" + seed + "/localization.tum"));
    ASSERT_GT(found.size(), 40u);
    for (std::size_t i = found.size() - 10; i < found.size(); ++i)
    {
      const auto there = poseAt(truth, found[i].time, 1);
      ASSERT_TRUE(there);
      const auto& here = found[i].pose;
      EXPECT_LT(std::hypot(here.x() - there->x(), here.y() - there->y()), 0.15) << "[m]";
      EXPECT_LT(std::abs(mrpt::math::wrapToPi(here.yaw() - there->yaw())), mrpt::DEG2RAD(5.0));
    }
  }
  EXPECT_NE(readFile(path("out1/localization.json")), readFile(path("out2/localization.json")));
}

TEST_F(Localize, IsMeasuredByTheScriptOfTheBenchmark)
{
  const auto result = runCommand(
      "PATH=" QUADMAP_BIN_DIR ":\"$PATH\" " QUADMAP_SOURCE_DIR
      "/share/quadmap/benchmark/localise " +
      path("first") + " " + path("second.rawlog") + " " + path("second.groundtruth.tum") +
      " 1 --particles 1000");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("1 of 1 seeds end within"), std::string::npos) << result.out;
}

TEST_F(Localize, ReportsEveryUpdate)
{
  ASSERT_EQ(localize("reported", "--particles 1000").status, 0);
  const json report = json::parse(readFile(path("reported/localization.json")));
  EXPECT_EQ(report["format"], "quadmap-localization");
  EXPECT_EQ(report["input"]["frames"], 60);
  EXPECT_EQ(report["particles"], 1000);
  std::size_t localised = 0;
  for (const auto& update : report["updates"]) localised += update["localised"].get<bool>();
  EXPECT_EQ(readTumTrajectory(path("reported/localization.tum")).size(), localised);
  EXPECT_FALSE(report["localised"].is_null());
}

TEST_F(Localize, WritesTheSameBytesWithAnyNumberOfThreads)
{
  for (const std::string threads : {"1", "3"})
    ASSERT_EQ(localize("threads" + threads, "--particles 500 --threads " + threads).status, 0);
  for (const std::string name : {"/localization.tum", "/localization.json"})
    EXPECT_EQ(readFile(path("threads1" + name)), readFile(path("threads3" + name))) << name;
}

TEST_F(Localize, StopsWhenAskedToAndKeepsWhatWasDone)
{
  LocalizationRequest request;
  request.rawlog = path("second.rawlog");
  request.mapFile = path("first");
  request.map = std::make_shared<CQuadricObjectMap>(readMap(request.mapFile));
  stopAfter(request, 20);
  const LocalizationResult result = localiseInMap(request);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.frames, 20u);
  const json report = json::parse(localizationToJson(request, result, "1.2"));
  EXPECT_EQ(report["input"]["interrupted"], true);
  EXPECT_EQ(report["updates"].size(), result.updates.size());
}

TEST_F(Localize, StopsBetweenImagesAsWell)
{
  for (int record = 1; record <= 6; ++record)
  {
    LocalizationRequest request;
    request.rawlog = path("second.rawlog");
    request.mapFile = path("first");
    request.map = std::make_shared<CQuadricObjectMap>(readMap(request.mapFile));
    stopOnceAfter(request, 5, record);
    EXPECT_TRUE(localiseInMap(request).interrupted) << record;
  }
}

TEST_F(Localize, AnInterruptedRunNeedNotHaveFoundTheRobot)
{
  for (const int frames : {0, 1})
  {
    LocalizationRequest request;
    request.rawlog = path("second.rawlog");
    request.mapFile = path("first");
    request.map = std::make_shared<CQuadricObjectMap>(readMap(request.mapFile));
    stopAfter(request, frames);
    LocalizationResult result;
    request.configuration.localization.localisedSigma = 1e-5;
    ASSERT_NO_THROW(result = localiseInMap(request)) << frames;
    EXPECT_TRUE(result.interrupted);
    EXPECT_TRUE(result.trajectory().empty());
    EXPECT_TRUE(json::parse(localizationToJson(request, result, "1.2"))["localised"].is_null());
  }
}

TEST_F(Localize, AMapWithoutObjectsIsNamed)
{
  CQuadricObjectMap().saveToFile(path("nothing.quadmap"));
  const auto result = runProgram(
      "quadmap-localize",
      path("second.rawlog") + " --map " + path("nothing.quadmap") + " -o " + path("x"));
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("nothing.quadmap: the map has no objects"), std::string::npos)
      << result.err;
}

TEST_F(Localize, SaysWhenTheRobotIsNotFound)
{
  const auto result = localize(
      "lost", "-c " + folder_->write("strict.ini", "[localization]\nlocalisedSigma = 0.00001\n"));
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("second.rawlog: the robot was not found in"), std::string::npos)
      << result.err;
  EXPECT_FALSE(std::filesystem::exists(path("lost/localization.tum")));
}

TEST_F(Localize, FewPosesAreNoSilentSuccess)
{
  Records records;
  std::size_t poses = 0;
  for (const auto& record : readRecords(path("second.rawlog")))
  {
    const auto pose = std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(record);
    if (!pose || pose->sensorLabel != kOdometryLabel || ++poses <= 20) records.push_back(record);
  }
  writeObjects(path("few.rawlog"), records);
  std::filesystem::copy_file(path("second.objects.rawlog"), path("few.objects.rawlog"));
  const auto run = [&](const std::string& options)
  {
    return runProgram(
        "quadmap-localize",
        path("few.rawlog") + " --map " + path("first") + " -o " + path("few") + options);
  };
  const auto strict = run("");
  EXPECT_EQ(strict.status, 1);
  EXPECT_NE(
      strict.err.find("few.rawlog: 40 of 60 images have no pose; --keep-going leaves them out"),
      kNotFound)
      << strict.err;
  const auto tolerant = run(" --keep-going");
  EXPECT_NE(tolerant.err.find("40 of 60 images have no pose and were left out"), kNotFound)
      << tolerant.err;
}

TEST_F(Localize, RefusesWhatItCannotUse)
{
  const std::string rawlog = path("second.rawlog"), map = " --map " + path("first");
  for (const std::string wrong :
       {" --particles 1", " --seed -1", " --threads 99", " --odometry graph:x", " --odometry no"})
    EXPECT_EQ(
        runProgram("quadmap-localize", rawlog + map + " -o " + path("wrong") + wrong).status, 2)
        << wrong;
  EXPECT_EQ(runProgram("quadmap-localize", rawlog + " -o x").status, 2) << "no map";
  const auto missing = runProgram("quadmap-localize", rawlog + " --map none -o " + path("x"));
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.err.find("none"), std::string::npos);
  const auto misspelt =
      localize("x", "-c " + folder_->write("bad.ini", "[localization]\nparticels = 5\n"));
  EXPECT_EQ(misspelt.status, 1);
  EXPECT_NE(misspelt.err.find("particels"), std::string::npos) << misspelt.err;
}

TEST_F(Localize, PrintsOptionsThatItReads)
{
  const auto defaults = runProgram("quadmap-localize", "--defaults");
  ASSERT_EQ(defaults.status, 0);
  EXPECT_NE(defaults.out.find("[localization]"), std::string::npos);
  EXPECT_EQ(localize("again", "-c " + folder_->write("all.ini", defaults.out)).status, 0);
}
