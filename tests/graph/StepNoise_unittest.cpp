#include "quadmap/graph/StepNoise.h"

#include <gtest/gtest.h>

#include "GraphWorld.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
/** Odometry that claims a share of what it errs by, in a world where all else is as the factors
 * say. */
GraphWorld worldOf(unsigned seed, double claim)
{
  GraphWorld::Size size;
  size.poses = 80;
  size.faceSigma = 0.005;  // the steps show
  size.yawSigma = 0.01;
  size.claim = claim;
  return GraphWorld(seed, size);
}

FactorGraphOptions gaussian()
{
  FactorGraphOptions options;
  options.floorSigma = 0;
  options.estimator.huber = 1e6;
  return options;
}

/** As a run does: each round believes what the round before found. */
StepNoise foundIn(GraphWorld& world)
{
  FactorGraph graph = world.graph(gaussian());
  StepNoise noise;
  for (int round = 0; round < 6; ++round)
  {
    graph.setStepNoise(noise);
    graph.optimise();
    noise = stepNoiseOf(graph.stepFit(), 1.0);
  }
  return noise;
}

}  // namespace

TEST(StepNoise, RightClaimsHaveResidualsAsExpected)
{
  StepFit sum;
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    GraphWorld world = worldOf(300 + seed, 1.0);
    FactorGraph graph = world.graph(gaussian());
    graph.optimise();
    sum += graph.stepFit();
  }
  // Over a thousand degrees of freedom: 0.15 are more than three standard deviations of the ratio.
  EXPECT_GT(sum.position.redundancy, 1000);
  EXPECT_GT(sum.angle.redundancy, 1000);
  EXPECT_NEAR(sum.position.squares / sum.position.redundancy, 1, 0.15);
  EXPECT_NEAR(sum.angle.squares / sum.angle.redundancy, 1, 0.15);
}

TEST(StepNoise, OdometryThatClaimsTooMuchIsFoundOut)
{
  double position = 0, angle = 0;
  constexpr int kWorlds = 12;
  for (unsigned seed = 0; seed < kWorlds; ++seed)
  {
    GraphWorld world = worldOf(400 + seed, 1.0 / 3);
    const StepNoise noise = foundIn(world);
    position += noise.position / kWorlds;
    angle += noise.angle / kWorlds;
  }
  EXPECT_NEAR(position, 3, 0.3);
  EXPECT_NEAR(angle, 3, 0.3);
}

TEST(StepNoise, OdometryThatIsBetterThanItClaimsIsFoundOut)
{
  double position = 0, angle = 0;
  constexpr int kWorlds = 12;
  for (unsigned seed = 0; seed < kWorlds; ++seed)
  {
    GraphWorld world = worldOf(500 + seed, 3.0);
    const StepNoise noise = foundIn(world);
    position += noise.position / kWorlds;
    angle += noise.angle / kWorlds;
  }
  EXPECT_NEAR(position, 1.0 / 3, 0.05);
  EXPECT_NEAR(angle, 1.0 / 3, 0.05);
}

TEST(StepNoise, IsNotBelowTheClaimWhereThatIsAskedFor)
{
  const StepNoise noise = StepNoise{0.5, 2}.atLeastClaimed();
  EXPECT_EQ(noise.position, 1);
  EXPECT_EQ(noise.angle, 2);
}

TEST(StepNoise, WhatIsKnownFromElsewhereIsNoOdometry)
{
  FactorGraph graph(gaussian());
  const mrpt::poses::CPose3D ahead(1, 0, 0, 0, 0, 0);
  mrpt::poses::CPose3DPDFGaussian step(ahead);
  for (int i = 0; i < 6; ++i) step.cov(i, i) = 0.01;
  graph.addPose({});
  graph.addPose(ahead);
  graph.addPose(ahead + ahead);
  graph.addKnownStep(0, 1, step);
  graph.addStep(1, 2, step);
  graph.setStepNoise({0.1, 0.1});
  graph.optimise();
  const auto marginals = graph.poseMarginals();
  EXPECT_NEAR(marginals[1](5, 5), 0.01, 1e-6);  // x of (turn, move) comes at 3
  EXPECT_NEAR(marginals[1](3, 3), 0.01, 1e-6);
  EXPECT_NEAR(marginals[2](3, 3) - marginals[1](3, 3), 0.01 * 0.01, 1e-6);
  EXPECT_NEAR(graph.stepFit().position.redundancy, 0, 1e-6);
  // Three steps around a loop share its three degrees of freedom by their variances. That of the
  // odometry is a hundredth of the others'.
  graph.addKnownStep(0, 2, step);
  EXPECT_GT(graph.stepFit().position.redundancy, 0);
  EXPECT_LT(graph.stepFit().position.redundancy, 0.05);
}

TEST(StepNoise, AWindowTellsTheSameOfItsSteps)
{
  StepFit sum;
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    GraphWorld world = worldOf(600 + seed, 1.0);
    FactorGraph graph(gaussian());
    constexpr std::size_t kWindow = 20;
    for (std::size_t k = 0; k < world.truth.size(); ++k)
    {
      const auto guess = k == 0 ? world.odometry[0]
                                : graph.pose(k - 1) + (world.odometry[k] - world.odometry[k - 1]);
      world.add(graph, k, guess);
      const std::size_t firstFree = k < kWindow ? 1 : k + 1 - kWindow;
      graph.optimiseWindow(firstFree);
      const auto fit =
          graph.windowFit(firstFree, {firstFree + 1, firstFree + (k < kWindow ? 1 : 2)});
      sum += fit.steps;
      const Eigen::Matrix<double, 6, 6> expected = graph.marginals(firstFree, false).lastPose;
      EXPECT_LE((fit.lastPose - expected).norm(), 1e-9 * expected.norm()) << k;
    }
  }
  EXPECT_GT(sum.position.redundancy, 1000);
  EXPECT_NEAR(sum.position.squares / sum.position.redundancy, 1, 0.2);
  EXPECT_NEAR(sum.angle.squares / sum.angle.redundancy, 1, 0.2);
}

TEST(StepNoise, FewResidualsDoNotOutweighTheClaim)
{
  StepFit fit;
  fit.position = {9, 1};  // three times the claim, but from one residual
  EXPECT_LT(stepNoiseOf(fit, 20).position, 1.2);
  EXPECT_EQ(stepNoiseOf(fit, 20).angle, 1);
  fit.position = {900, 100};
  EXPECT_GT(stepNoiseOf(fit, 20).position, 2.7);
}
