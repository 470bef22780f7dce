#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "FolderContents.h"
#include "MappedRoom.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/obs/Trajectory.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
/** A folder as quadmap-slam writes it, and its truth. All is perfect except one missed object. */
class QuadmapEvaluate : public ::testing::Test
{
 protected:
  QuadmapEvaluate()
  {
    Trajectory trajectory;
    for (int i = 0; i < 10; ++i)
      trajectory.push_back({10.0 + i, CPose3D(std::cos(i), std::sin(i), 0.1 * i, 0.2 * i, 0, 0)});
    writeTumTrajectory(folder_.path("trajectory.tum"), trajectory);
    writeTumTrajectory(folder_.path("gt.tum"), trajectory);

    ObjectRecord cup, chair;
    cup.id = "1";
    cup.label = "cup";
    chair.id = "2";
    chair.label = "chair";
    chair.object = Ellipsoid(CPose3D(4, 0, 0, 0, 0, 0), {0.3, 0.3, 0.5});
    writeObjectsJson(folder_.path("objects.json"), {cup});
    writeObjectsJson(folder_.path("gt.json"), {cup, chair});
  }

  /** Arguments with DIR for the folder. */
  ProgramResult run(const std::string& arguments)
  {
    return runProgram("quadmap-evaluate", replaced(arguments, "DIR", folder_.folder().string()));
  }

  TemporaryFolder folder_;
};
}  // namespace

TEST_F(QuadmapEvaluate, PrintsATableAndWritesJson)
{
  const auto result =
      run("DIR --objects DIR/gt.json --trajectory DIR/gt.tum --json DIR/figures.json");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("2 true, 1 estimated, 1 matched"), kNotFound) << result.out;
  EXPECT_NE(result.out.find("Missed:\n  chair"), kNotFound) << result.out;
  EXPECT_TRUE(result.err.empty()) << result.err;
  const auto json = nlohmann::json::parse(readFile(folder_.path("figures.json")));
  EXPECT_EQ(json["objects"]["recall"], 0.5);
  EXPECT_TRUE(json["trajectory"]["ate_rmse_odometry_m"].is_null());
}

TEST_F(QuadmapEvaluate, TakesEitherTruthAlone)
{
  const auto objects = run("DIR --objects DIR/gt.json");
  EXPECT_EQ(objects.status, 0) << objects.err;
  EXPECT_EQ(objects.out.find("ATE"), kNotFound);
  EXPECT_NE(objects.out.find("in place"), kNotFound) << "said, because nothing was aligned";
  const auto trajectory = run("DIR --trajectory DIR/gt.tum");
  EXPECT_EQ(trajectory.status, 0) << trajectory.err;
  EXPECT_NE(trajectory.out.find("ATE"), kNotFound);
}

TEST_F(QuadmapEvaluate, ComparesATrajectoryAlone)
{
  const auto result = run("DIR/trajectory.tum --trajectory DIR/gt.tum --json DIR/figures.json");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("ATE RMSE 0.0000 m over 10 of 10 poses"), kNotFound) << result.out;
  const auto json = nlohmann::json::parse(readFile(folder_.path("figures.json")));
  EXPECT_NEAR(json["trajectory"]["ate_rmse_m"].get<double>(), 0, 1e-9);
}

TEST_F(QuadmapEvaluate, ComparesAMapAlone)
{
  const std::string home = QUADMAP_SOURCE_DIR "/tests/maps/data/home-archive-version-0.quadmap";
  const std::string truth = QUADMAP_SOURCE_DIR "/rawlogs/home.objects.gt.json";
  const auto map = run("'" + home + "' --objects '" + truth + "'");
  EXPECT_EQ(map.status, 0) << map.err;
  EXPECT_NE(map.out.find("16 true, 16 estimated, 16 matched"), kNotFound) << map.out;
  const auto list = run("DIR/objects.json --objects DIR/gt.json");
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_NE(list.out.find("2 true, 1 estimated, 1 matched"), kNotFound) << list.out;

  const auto aligned = run("'" + home + "' --objects '" + truth + "' --trajectory DIR/gt.tum");
  EXPECT_EQ(aligned.status, 1);
  EXPECT_NE(aligned.err.find("a map by itself has no trajectory"), kNotFound) << aligned.err;
  folder_.write(
      "moved.json", R"({"objects":[{"id":1,"label":"cup","center":[0,0,0],"size":[1,1,1],)"
                    R"("orientation_defined":false,"to":12}]})");
  const auto moved = run("DIR/objects.json --objects DIR/moved.json");
  EXPECT_EQ(moved.status, 1);
  EXPECT_NE(moved.err.find("does not say which objects of"), kNotFound) << moved.err;
}

TEST_F(QuadmapEvaluate, WritesTheReportOfTheRunWithTheFigures)
{
  const std::string arguments =
      "DIR --objects DIR/gt.json --trajectory DIR/gt.tum --html DIR/r.html";
  const auto none = run(arguments);
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("report.json: cannot be read"), kNotFound) << none.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("r.html")));

  folder_.write("report.json", R"({"input": {"file": "room.rawlog"}})");
  std::filesystem::copy(folder_.path("trajectory.tum"), folder_.path("trajectory_odometry.tum"));
  const auto result = run(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string page = readFile(folder_.path("r.html"));
  EXPECT_NE(page.find("room.rawlog"), kNotFound);
  EXPECT_NE(page.find("<td>ATE RMSE [m]</td><td class=\"number\">0.0000</td>"), kNotFound);
  EXPECT_NE(
      page.find("<td>recall</td><td class=\"number\"></td><td class=\"number\">0.50</td>"),
      kNotFound);

  const auto alone = run("DIR/trajectory.tum --trajectory DIR/gt.tum --html DIR/x.html");
  EXPECT_EQ(alone.status, 2);
}

TEST_F(QuadmapEvaluate, ReplacesNoFileThatItReadsButTheReportPage)
{
  folder_.write("report.json", R"({"input": {"file": "room.rawlog"}})");
  std::filesystem::copy(folder_.path("trajectory.tum"), folder_.path("trajectory_odometry.tum"));
  std::filesystem::create_symlink("report.json", folder_.path("figures"));
  const auto before = contentsOf(folder_.folder());
  for (const char* output :
       {"--json DIR/objects.json", "--json DIR/gt.json", "--json DIR/figures",
        "--json DIR/report.json", "--html DIR/trajectory.tum", "--html DIR/new.quadmap",
        "--json DIR/report.html"})
  {
    const auto result = run("DIR --objects DIR/gt.json --in-place " + std::string(output));
    EXPECT_EQ(result.status, 2) << output;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
  }
  EXPECT_EQ(
      run("DIR/objects.json --objects DIR/gt.json --in-place --json DIR/report.json").status, 2);
  EXPECT_EQ(contentsOf(folder_.folder()), before);
  folder_.write("report.html", "as quadmap-slam wrote it");
  const auto page = run("DIR --objects DIR/gt.json --in-place --html DIR/report.html");
  EXPECT_EQ(page.status, 0) << page.err;
  EXPECT_NE(readFile(folder_.path("report.html")).find("recall"), kNotFound);
}

TEST_F(QuadmapEvaluate, WritesTheAteWithAllItsDigits)
{
  const std::string given = QUADMAP_SOURCE_DIR "/tests/evaluation/trajectories/loop_";
  const auto result = run(
      "'" + given + "estimate.tum' --trajectory '" + given + "truth.tum' --json DIR/figures.json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(readFile(folder_.path("figures.json")));
  EXPECT_NEAR(json["trajectory"]["ate_rmse_m"].get<double>(), 0.024371786, 1e-6)
      << "as in EvoAgreement_unittest.cpp";
}

TEST_F(QuadmapEvaluate, TellsTheAlignmentWhenDebugging)
{
  const auto result = run("DIR --trajectory DIR/gt.tum -v debug");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("pose of the map"), kNotFound);
}

TEST_F(QuadmapEvaluate, ShowsHelpAndVersion)
{
  const auto help = run("--help");
  EXPECT_EQ(help.status, 0);
  for (const char* option : {"--objects", "--trajectory", "--json", "--in-place", "--verbosity"})
    EXPECT_NE(help.out.find(option), kNotFound) << option;
  const auto version = run("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.find("quadmap-evaluate "), 0u);
  EXPECT_TRUE(isOneLine(version.out)) << version.out;
}

TEST_F(QuadmapEvaluate, AnswersWrongUsageWithStatus2AndOneLine)
{
  for (const char* arguments :
       {"", "DIR", "--objects DIR/gt.json", "DIR --objects", "DIR --objcts DIR/gt.json",
        "DIR --self --html DIR/r.html", "DIR another --objects DIR/gt.json",
        "DIR --objects DIR/gt.json -v loud",
        "DIR --trajectory DIR/gt.tum --max-time-difference ten",
        "DIR --trajectory DIR/gt.tum --max-time-difference -1"})
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find("quadmap-evaluate: "), 0u) << result.err;
    EXPECT_TRUE(result.out.empty()) << result.out;
  }
}

TEST_F(QuadmapEvaluate, AnswersBadInputWithStatus1AndOneLineNamingTheFile)
{
  folder_.write("broken.json", "{\"objects\": [");
  folder_.write("short.tum", "1 2 3 4 5 6 7\n");
  folder_.write("other.tum", "1e6 0 0 0 0 0 0 1\n");
  const std::pair<const char*, const char*> cases[] = {
      {                               "DIR/nowhere --objects DIR/gt.json",                                "nowhere"},
      {"DIR/trajectory.tum --objects DIR/gt.json --trajectory DIR/gt.tum",                         "trajectory.tum"},
      {                                     "DIR --objects DIR/none.json",                              "none.json"},
      {                                   "DIR --objects DIR/broken.json",                            "broken.json"},
      {                                   "DIR --trajectory DIR/none.tum",                               "none.tum"},
      {                                  "DIR --trajectory DIR/short.tum", "short.tum:1: expected 8 columns, got 7"},
      {                                  "DIR --trajectory DIR/other.tum",                              "other.tum"},
      {        "DIR --objects DIR/gt.json --json DIR/no/such/folder.json",                            "folder.json"}
  };
  for (const auto& [arguments, name] : cases)
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 1) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find("quadmap-evaluate: "), 0u) << result.err;
    EXPECT_NE(result.err.find(name), kNotFound) << result.err;
  }
}

TEST_F(QuadmapEvaluate, LeavesNoJsonWhenItFails)
{
  const auto before = folder_.fileCount();
  EXPECT_EQ(run("DIR --objects DIR/none.json --json DIR/figures.json").status, 1);
  EXPECT_EQ(folder_.fileCount(), before);
}

TEST_F(QuadmapEvaluate, WritesBothFilesOrNone)
{
  folder_.write("report.json", R"({"input": {"file": "room.rawlog"}})");
  std::filesystem::copy(folder_.path("trajectory.tum"), folder_.path("trajectory_odometry.tum"));
  folder_.write("figures.json", "of an earlier call");
  const auto before = contentsOf(folder_.folder());
  const auto result =
      run("DIR --objects DIR/gt.json --in-place --json DIR/figures.json --html DIR/none/page.html");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("none/page.html"), kNotFound) << result.err;
  EXPECT_EQ(contentsOf(folder_.folder()), before);
}

TEST_F(QuadmapEvaluate, ComparesWithTheDepthImagesWhereTheyAre)
{
  const auto expectError = [&](const std::string& arguments, int status, const std::string& text)
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, status) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(text), kNotFound) << result.err;
  };
  expectError("DIR --objects DIR/gt.json --config DIR/x.ini", 2, "belongs to --self");
#ifdef QUADMAP_WITH_PCL
  expectError("DIR --self", 1, "map.simplemap");
  expectError("DIR/gt.tum --self", 1, "needs a folder");

  ASSERT_NO_FATAL_FAILURE(mapRoom(
      folder_.path("room"), "home --resolution 160x120 --frames 30", "--odometry ground-truth"));
  folder_.write("d.ini", "[dense]\nobjectCell = 0.02\ngrowDistance = 0.06\n");
  const auto result = run("DIR/room --self -c DIR/d.ini --json DIR/self.json");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("through"), kNotFound) << result.out;
  const auto self = nlohmann::json::parse(readFile(folder_.path("self.json"))).at("self");
  EXPECT_GE(self.at("objects").size(), 5u);
  EXPECT_LT(self.at("beyond"), 0.15);
  EXPECT_LT(self.at("through"), 0.25);
#else
  expectError("DIR --self", 1, "built without PCL");
#endif
}
