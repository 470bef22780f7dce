#include <gtest/gtest.h>

#include "../SyntheticRoom.h"
#include "quadmap/evaluation/EvaluationReport.h"
#include "quadmap/simulator/Simulator.h"
#include "quadmap/slam/RawlogRun.h"

using namespace quadmap;

// A long way there and back, with odometry that drifts several times as much as it claims: what is
// seen again must not become other things, and the user is told.
TEST(NoisyOdometry, IsFoundOutAndTrustedLess)
{
  const TemporaryFolder folder;
  auto scene = simulator::readScene(simulator::findScene("corridor"));
  scene.options.resize(240, 180);
  simulator::NoiseFactors factors;
  factors.odometry = 6;
  scene.options.scaleNoise(factors);
  simulator::simulateToFiles(
      simulator::Simulator(scene, LabelTable::installed(), 18), folder.path("a.rawlog"));

  RawlogRunRequest request;
  request.rawlog = folder.path("a.rawlog");
  request.outputDirectory = folder.path("out");
  const SlamResult result = runOnRawlog(request).result;
  ASSERT_TRUE(result.correction);
  EXPECT_GT(result.correction->stepNoise.position, 2);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("the odometry errs by more than it claims"), std::string::npos);

  EvaluationInput input;
  input.estimate = request.outputDirectory;
  input.trueObjectsPath = folder.path("a.objects.gt.json");
  input.trueTrajectoryPath = folder.path("a.groundtruth.tum");
  const EvaluationReport report = evaluateRun(input);
  EXPECT_EQ(report.objects->f1().value_or(0), 1);
  EXPECT_LT(report.trajectory->ateRmse, 0.15);
}
