#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../SyntheticRoom.h"
#include "quadmap/evaluation/EvaluationReport.h"
#include "quadmap/simulator/Simulator.h"
#include "quadmap/slam/RawlogRun.h"

using namespace quadmap;

namespace
{
/** Maps an installed scene, with fewer and smaller images than it says, and compares with the
 * truth.
 */
class SceneFloors : public ::testing::Test
{
 protected:
  EvaluationReport map(const std::string& name, PoseSource odometry = PoseSource::Auto)
  {
    auto scene = simulator::readScene(simulator::findScene(name));
    scene.options.resize(240, 180);
    scene.options.trajectory.frames = 150;
    simulator::simulateToFiles(
        simulator::Simulator(scene, LabelTable::installed(), 1), folder_.path("a.rawlog"));
    RawlogRunRequest request;
    request.rawlog = folder_.path("a.rawlog");
    request.outputDirectory = folder_.path("out");
    request.configuration.slam.odometry = odometry;
    run_ = runOnRawlog(request);
    EvaluationInput input;
    input.estimate = request.outputDirectory;
    input.trueObjectsPath = folder_.path("a.objects.gt.json");
    input.trueTrajectoryPath = folder_.path("a.groundtruth.tum");
    return evaluateRun(input);
  }

  RawlogRunSummary run_;

 private:
  TemporaryFolder folder_;
};

class SeveralFloors : public SceneFloors, public ::testing::WithParamInterface<const char*>
{
};

double bottomOf(const ObjectRecord& record)
{
  return record.object.center().z() - record.object.semiAxes().z();
}

}  // namespace

TEST_P(SeveralFloors, AreMappedAtTheirHeights)
{
  const auto report = map(GetParam());
  EXPECT_EQ(run_.result.droppedFloors, 0U);
  EXPECT_TRUE(run_.result.warnings.empty());
  EXPECT_GE(report.objects->f1().value_or(0), 0.9);
  EXPECT_LT(report.trajectory->ateRmse, *report.trajectory->ateRmseOdometry);
  std::size_t raised = 0;
  for (const auto& match : report.objects->matches)
  {
    if (match.truth.label != "chair" || bottomOf(match.truth) < 0.2) continue;
    ++raised;
    EXPECT_NEAR(bottomOf(match.estimated), bottomOf(match.truth), 0.08) << match.truth.id;
    EXPECT_NEAR(match.estimated.object.semiAxes().z(), match.truth.object.semiAxes().z(), 0.02)
        << match.truth.id << " reaches down to another floor";
  }
  EXPECT_EQ(raised, 3U) << "chairs upstairs, or on the dais";
}

INSTANTIATE_TEST_SUITE_P(Scenes, SeveralFloors, ::testing::Values("dais", "two-storeys"));

namespace
{
/** Chairs and a table end at the floor that no image shows, and not where a table hides them. */
void expectFurnitureReachesDown(const EvaluationReport& report)
{
  std::size_t judged = 0;
  for (const auto& match : report.objects->matches)
  {
    if (match.truth.label != "chair" && match.truth.label != "dining table") continue;
    ++judged;
    EXPECT_NEAR(bottomOf(match.estimated), bottomOf(match.truth), 0.12) << match.truth.id;
    EXPECT_GE(match.comparison.shapeIoU, 0.65) << match.truth.id;
  }
  EXPECT_GE(judged, 5U) << "of five chairs and a table";
}
}  // namespace

TEST_F(SceneFloors, NoneInSightLosesNothing)
{
  const auto report = map("no-floor");
  EXPECT_TRUE(run_.result.warnings.empty());
  EXPECT_GE(report.objects->f1().value_or(0), 0.9);
  expectFurnitureReachesDown(report);
}

TEST_F(SceneFloors, NoneInSightAndUpIsFoundBySurfaces)
{
  const auto report = map("no-floor", PoseSource::Visual);
  EXPECT_EQ(run_.result.odometry.upOrigin, UpOrigin::Surfaces);
  EXPECT_GE(report.objects->f1().value_or(0), 0.9);
}
