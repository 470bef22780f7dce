#include <gtest/gtest.h>

#include "../SyntheticRoom.h"
#include "quadmap/evaluation/EvaluationReport.h"
#include "quadmap/simulator/Simulator.h"
#include "quadmap/slam/RawlogRun.h"

using namespace quadmap;

// A long way there and back, with odometry that drifts ten times as much as it claims. The things
// on the way back do not overlap those on the way there, and are other ones until all are compared.
TEST(LoopClosure, MakesDoublesOne)
{
  const TemporaryFolder folder;
  auto scene = simulator::readScene(simulator::findScene("corridor"));
  scene.options.resize(320, 240);
  simulator::NoiseFactors factors;
  factors.odometry = 10;
  scene.options.scaleNoise(factors);
  simulator::simulateToFiles(
      simulator::Simulator(scene, LabelTable::installed(), 3), folder.path("a.rawlog"));

  RawlogRunRequest request;
  request.rawlog = folder.path("a.rawlog");
  request.outputDirectory = folder.path("out");
  const SlamResult result = runOnRawlog(request).result;
  EXPECT_GE(result.loops.closed, 1);
  EXPECT_FALSE(result.loops.open);

  EvaluationInput input;
  input.estimate = request.outputDirectory;
  input.trueObjectsPath = folder.path("a.objects.gt.json");
  input.trueTrajectoryPath = folder.path("a.groundtruth.tum");
  const EvaluationReport report = evaluateRun(input);
  EXPECT_GE(report.objects->f1().value_or(0), 0.8) << "0.33 with the doubles";
  EXPECT_LT(report.trajectory->ateRmse, 0.2) << "[m]; 0.92 with the doubles";
}
