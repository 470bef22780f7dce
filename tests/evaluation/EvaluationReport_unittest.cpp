#include "quadmap/evaluation/EvaluationReport.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../geometry/RandomGeometry.h"
#include "../obs/TemporaryFolder.h"

using namespace quadmap;
using namespace quadmap::test;
using mrpt::poses::CPose3D;
using nlohmann::json;

namespace
{
/** A run whose map is displaced from the true world, with known errors. At the corners of a square,
 * the poses of the trajectory are alternately 0.1 m too high and too low, and those of the odometry
 * 0.2 m. */
class EvaluatedRun : public ::testing::Test
{
 protected:
  EvaluatedRun()
  {
    writeTumTrajectory(folder_.path("gt.tum"), square(T_truth_map_, 0));
    writeTumTrajectory(folder_.path("trajectory.tum"), square(CPose3D(), 0.1));
    writeTumTrajectory(
        folder_.path("trajectory_odometry.tum"), square(CPose3D(1, 2, 3, 4, 0, 0), 0.2));

    writeObjectsJson(
        folder_.path("objects.json"), {record("7", "cup", 0, 0), record("8", "tv", 1, 0)});
    auto cup = record("cup-a", "cup", 0.03, 0.04), chair = record("3", "chair", 5, 5);
    cup.object = cup.object.transformed(T_truth_map_);
    chair.object = chair.object.transformed(T_truth_map_);
    writeObjectsJson(folder_.path("gt.json"), {cup, chair});

    input_.estimate = folder_.path("");
    input_.trueObjectsPath = folder_.path("gt.json");
    input_.trueTrajectoryPath = folder_.path("gt.tum");
  }

  static ObjectRecord record(const std::string& id, const std::string& label, double x, double y)
  {
    ObjectRecord r;
    r.id = id;
    r.label = label;
    r.object = Ellipsoid(CPose3D(x, y, 0, 0, 0, 0), {0.1, 0.2, 0.3});
    return r;
  }

  static Trajectory square(const CPose3D& T, double height)
  {
    Trajectory trajectory;
    for (int i = 0; i < 8; ++i)
    {
      const double x = i % 4 < 2 ? 1 : -1, y = (i + 1) % 4 < 2 ? 1 : -1;
      trajectory.push_back({100.0 + i, T + CPose3D(x, y, i % 2 ? height : -height, 0, 0, 0)});
    }
    return trajectory;
  }

  std::string errorWith(const EvaluationInput& input)
  {
    return errorOf([&] { evaluateRun(input); });
  }

  const CPose3D T_truth_map_{3, -2, 1, 0.5, 0, M_PI / 2};  // a world that is not z-up
  TemporaryFolder folder_;
  EvaluationInput input_;
};
}  // namespace

TEST_F(EvaluatedRun, AlignsAndCompares)
{
  const EvaluationReport report = evaluateRun(input_);
  ASSERT_TRUE(report.trajectory);
  EXPECT_NEAR(report.trajectory->ateRmse, 0.1, 1e-6);
  ASSERT_TRUE(report.trajectory->ateRmseOdometry);
  EXPECT_NEAR(*report.trajectory->ateRmseOdometry, 0.2, 1e-6) << "aligned on its own";
  EXPECT_EQ(report.trajectory->pairs, 8u);
  EXPECT_TRUE(report.notes.empty());
  ASSERT_TRUE(report.objects);
  ASSERT_EQ(report.objects->matches.size(), 1u);
  EXPECT_NEAR(report.objects->matches[0].comparison.centerDistance, 0.05, 1e-6);
}

TEST_F(EvaluatedRun, TheErrorOfASinglePoseIsNoFigure)
{
  writeTumTrajectory(folder_.path("trajectory.tum"), {square(CPose3D(), 0.1).front()});
  const EvaluationReport report = evaluateRun(input_);
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes.front().find("only one pose"), std::string::npos);
  input_.trueObjectsPath.reset();
  EXPECT_NE(errorWith(input_).find("trajectory.tum: only one pose"), std::string::npos);
  input_.inPlace = true;
  EXPECT_EQ(errorWith(input_), "");
}

TEST_F(EvaluatedRun, WritesTheJsonOfTheDesign)
{
  const json j = json::parse(toJson(evaluateRun(input_)));
  EXPECT_EQ(j.size(), 5u);
  EXPECT_EQ(j["format"], "quadmap-evaluation");
  EXPECT_EQ(j["version"], 1);
  EXPECT_EQ(j["trajectory"].size(), 3u);
  EXPECT_NEAR(j["trajectory"]["ate_rmse_m"].get<double>(), 0.1, 1e-6);
  EXPECT_NEAR(j["trajectory"]["ate_rmse_odometry_m"].get<double>(), 0.2, 1e-6);
  EXPECT_EQ(j["trajectory"]["keyframes"], 8);
  const json& o = j["objects"];
  EXPECT_EQ(o.size(), 13u);
  EXPECT_EQ(o["truth"], 2);
  EXPECT_EQ(o["estimated"], 2);
  EXPECT_EQ(o["matched"], 1);
  EXPECT_EQ(o["precision"], 0.5);
  EXPECT_EQ(o["recall"], 0.5);
  EXPECT_EQ(o["f1"], 0.5);
  EXPECT_NEAR(o["trans_m"].get<double>(), 0.05, 1e-6);
  EXPECT_NEAR(o["rot_deg"].get<double>(), 0, 1e-4);
  EXPECT_NEAR(o["shape_iou"].get<double>(), 1, 1e-6);
  // Boxes 0.2 x 0.4 x 0.6 shifted by (0.03, 0.04).
  EXPECT_NEAR(o["iou_3d"].get<double>(), 0.17 * 0.36 / (2 * 0.08 - 0.17 * 0.36), 1e-5);
  ASSERT_EQ(j["matches"].size(), 1u);
  const json& m = j["matches"][0];
  EXPECT_EQ(m.size(), 10u);
  EXPECT_EQ(m["truth_id"], "cup-a");
  EXPECT_EQ(m["id"], 7);
  EXPECT_EQ(m["label"], "cup");
  for (const char* key : {"trans_m", "rot_deg", "shape_iou", "iou_3d"}) EXPECT_EQ(m[key], o[key]);
}

TEST_F(EvaluatedRun, WritesNullForWhatDoesNotExist)
{
  input_.trueObjectsPath.reset();
  std::filesystem::remove(folder_.path("trajectory_odometry.tum"));
  const json withoutObjects = json::parse(toJson(evaluateRun(input_)));
  EXPECT_TRUE(withoutObjects["trajectory"]["ate_rmse_odometry_m"].is_null());
  for (const auto& [key, value] : withoutObjects["objects"].items())
    EXPECT_TRUE(value.is_null()) << key;
  EXPECT_EQ(withoutObjects["objects"].size(), 13u);
  EXPECT_EQ(withoutObjects["matches"], json::array());

  input_.trueObjectsPath = folder_.path("gt.json");
  input_.trueTrajectoryPath.reset();
  const json inPlace = json::parse(toJson(evaluateRun(input_)));
  for (const auto& [key, value] : inPlace["trajectory"].items())
    EXPECT_TRUE(value.is_null()) << key;
  EXPECT_EQ(inPlace["objects"]["matched"], 0) << "the worlds differ and nothing aligned them";
  EXPECT_EQ(inPlace["objects"]["f1"], 0.0);
  for (const char* key : {"trans_m", "rot_deg", "shape_iou", "iou_3d"})
    EXPECT_TRUE(inPlace["objects"][key].is_null()) << key;
}

TEST_F(EvaluatedRun, HasNoOdometryFigureForAnEmptyFile)
{
  folder_.write("trajectory_odometry.tum", "# time tx ty tz qx qy qz qw\n");
  EXPECT_FALSE(evaluateRun(input_).trajectory->ateRmseOdometry);
}

TEST_F(EvaluatedRun, ComparesInPlaceWhenAsked)
{
  input_.inPlace = true;
  writeTumTrajectory(folder_.path("gt.tum"), square(CPose3D(0, 0, 2, 0, 0, 0), 0.1));
  const auto report = evaluateRun(input_);
  EXPECT_NEAR(report.trajectory->ateRmse, 2, 1e-6);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("in place"), std::string::npos);
}

TEST_F(EvaluatedRun, TellsOfTrajectoriesThatMayBeCut)
{
  for (const char* name : {"trajectory.tum", "gt.tum"})
  {
    const std::string whole = readFile(folder_.path(name));
    folder_.write(name, whole.substr(0, whole.size() - 2));
    const auto notes = evaluateRun(input_).notes;
    folder_.write(name, whole);
    ASSERT_EQ(notes.size(), 1u) << name;
    EXPECT_EQ(notes[0].find(folder_.path(name) + " ends without a line break: "), 0u) << notes[0];
  }
}

TEST_F(EvaluatedRun, SaysWhenOrientationsWereNeeded)
{
  Trajectory line;
  for (int i = 0; i < 10; ++i) line.push_back({100.0 + i, CPose3D(0.1 * i, 0, 0, 0, 0, 0)});
  writeTumTrajectory(folder_.path("trajectory.tum"), line);
  for (auto& pose : line) pose.pose = T_truth_map_ + pose.pose;
  writeTumTrajectory(folder_.path("gt.tum"), line);
  const auto report = evaluateRun(input_);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_NE(report.notes[0].find("orientations"), std::string::npos);
  EXPECT_EQ(report.objects->matches.size(), 1u);
  EXPECT_NE(toTable(report).find(report.notes[0]), std::string::npos);
}

TEST_F(EvaluatedRun, JudgesObjectsThatComeAndGoAsOfTheEndOfTheRun)
{
  // The run's poses are at 100 ... 107 s.
  auto cup = record("a", "cup", 0, 0), gone = record("b", "cup", 1, 1),
       before = record("c", "tv", 3, 0), after = record("d", "tv", 1, 0),
       later = record("e", "vase", 2, 2);
  gone.to = 107;
  before.to = 105;
  after.from = 105;
  later.from = 107.5;
  writeObjectsJson(folder_.path("moved.json"), {cup, gone, before, after, later});
  input_.trueTrajectoryPath.reset();
  input_.trueObjectsPath = folder_.path("moved.json");
  const auto report = evaluateRun(input_);
  ASSERT_EQ(report.objects->matches.size(), 2u);
  EXPECT_EQ(report.objects->matches[0].truth.id, "a");
  EXPECT_EQ(report.objects->matches[1].truth.id, "d");
  EXPECT_TRUE(report.objects->missed.empty());
  ASSERT_EQ(report.notes.size(), 2u);
  EXPECT_NE(report.notes[1].find("the 2 that stand there at the end"), std::string::npos);

  std::filesystem::remove(folder_.path("trajectory.tum"));
  EXPECT_NE(errorWith(input_).find("trajectory.tum"), std::string::npos);
}

TEST_F(EvaluatedRun, ListsMatchesMissedAndFalseObjectsForPeople)
{
  const std::string table = toTable(evaluateRun(input_));
  EXPECT_NE(table.find("ATE RMSE 0.1000 m over 8 of 8 poses"), std::string::npos) << table;
  EXPECT_NE(table.find("2 true, 2 estimated, 1 matched"), std::string::npos) << table;
  EXPECT_NE(table.find("cup-a = 7"), std::string::npos) << table;
  EXPECT_LT(table.find("Missed:\n  chair"), table.find("False:\n  tv")) << table;
}

TEST_F(EvaluatedRun, NamesTheFileThatIsMissingOrWrong)
{
  auto noFolder = input_;
  noFolder.estimate = folder_.path("nowhere");
  EXPECT_NE(errorWith(noFolder).find("nowhere: no such folder"), std::string::npos);

  auto noTruth = input_;
  noTruth.trueTrajectoryPath = folder_.path("none.tum");
  EXPECT_NE(errorWith(noTruth).find("none.tum"), std::string::npos);

  folder_.write("bad.tum", "1 2 3\n");
  noTruth.trueTrajectoryPath = folder_.path("bad.tum");
  EXPECT_NE(errorWith(noTruth).find("bad.tum:1: expected 8 columns, got 3"), std::string::npos);

  folder_.write("other.tum", "5000 0 0 0 0 0 0 1\n");
  noTruth.trueTrajectoryPath = folder_.path("other.tum");
  EXPECT_NE(errorWith(noTruth).find("within 0.02 s"), std::string::npos) << errorWith(noTruth);

  std::filesystem::remove(folder_.path("objects.json"));
  EXPECT_NE(errorWith(input_).find("objects.json"), std::string::npos);
}
