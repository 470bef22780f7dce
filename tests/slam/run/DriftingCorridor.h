#pragma once

#include <utility>

#include "../SyntheticRoom.h"
#include "quadmap/evaluation/EvaluationReport.h"
#include "quadmap/simulator/Simulator.h"
#include "quadmap/slam/RawlogRun.h"

namespace quadmap
{
/** A run through a scene, and how far it is from the truth. */
struct DriftingRun
{
  SlamResult result;
  EvaluationReport report;
};

/** \param drift How many times as much as it claims the odometry drifts.
 *  \param earlier Map of an earlier run that goes on in this one; null: there is none. */
inline DriftingRun driftingRun(
    simulator::Scene scene,
    double drift,
    std::uint64_t seed,
    const CQuadricObjectMap::ConstPtr& earlier = nullptr)
{
  const TemporaryFolder folder;
  simulator::NoiseFactors factors;
  factors.odometry = drift;
  scene.options.scaleNoise(factors);
  simulator::simulateToFiles(
      simulator::Simulator(scene, LabelTable::installed(), seed), folder.path("a.rawlog"));

  RawlogRunRequest request;
  request.rawlog = folder.path("a.rawlog");
  request.outputDirectory = folder.path("out");
  request.map = earlier;
  DriftingRun run;
  run.result = runOnRawlog(request).result;

  EvaluationInput input;
  input.estimate = request.outputDirectory;
  input.trueObjectsPath = folder.path("a.objects.gt.json");
  input.trueTrajectoryPath = folder.path("a.groundtruth.tum");
  run.report = evaluateRun(input);
  return run;
}

/** Along a corridor and back. \param width,height Of the images [px]. For the others see above. */
inline DriftingRun driftingCorridor(
    unsigned width,
    unsigned height,
    double drift,
    std::uint64_t seed,
    const CQuadricObjectMap::ConstPtr& earlier = nullptr)
{
  auto scene = simulator::readScene(simulator::findScene("corridor"));
  scene.options.resize(width, height);
  return driftingRun(std::move(scene), drift, seed, earlier);
}
}  // namespace quadmap
