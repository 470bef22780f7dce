#include <gtest/gtest.h>

#include "../geometry/Algebra.h"
#include "../maps/SyntheticScene.h"
#include "GraphWorld.h"
#include "quadmap/estimation/RepeatedErrors.h"
#include "quadmap/estimation/ViewResiduals.h"
#include "quadmap/maps/ObjectEstimator.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

TEST(FactorGraph, TheWindowCostsTheSameHoweverLongTheRun)
{
  GraphWorld::Size size;
  size.poses = 200;
  size.circles = 3;
  GraphWorld world(4, size);
  FactorGraph graph(plain());
  std::size_t largest = 0, largestEarly = 0;
  for (std::size_t k = 0; k < world.truth.size(); ++k)
  {
    const CPose3D guess = k == 0 ? world.odometry[0]
                                 : graph.pose(k - 1) + (world.odometry[k] - world.odometry[k - 1]);
    world.add(graph, k, guess);
    const auto summary = graph.optimiseWindow(k < 10 ? 1 : k - 9);
    EXPECT_LE(summary.freePoses, 10u);
    (k < 66 ? largestEarly : largest) =
        std::max(k < 66 ? largestEarly : largest, summary.residuals);
  }
  EXPECT_LE(largest, largestEarly * 11 / 10) << "three rounds of the same circle";
}

TEST(FactorGraph, WhatIsFoldedCanBeForgotten)
{
  constexpr std::size_t kWindow = 10;
  const auto drive = [](bool keepsFolded)
  {
    GraphWorld world(4);
    auto options = plain();
    options.keepsFolded = keepsFolded;
    FactorGraph graph(options);
    for (std::size_t k = 0; k < world.truth.size(); ++k)
    {
      world.add(graph, k, world.odometry[k]);
      graph.optimiseWindow(k < kWindow ? 1 : k + 1 - kWindow);
      if (k == world.truth.size() / 2) graph.removeObject(1, 2);
    }
    return graph;
  };
  const FactorGraph kept = drive(true), forgotten = drive(false);
  for (std::size_t k = 0; k < kept.poses(); ++k)
    EXPECT_EQ(forgotten.pose(k).distanceTo(kept.pose(k)), 0) << k;
  EXPECT_LT(forgotten.viewCount(), kept.viewCount() / 2);
  EXPECT_GT(forgotten.viewCount(), 0u);
}

TEST(FactorGraph, TheWindowFollowsTheRobotAndRevisitsReconnectIt)
{
  for (const unsigned seed : {1u, 2u, 3u})
  {
    GraphWorld::Size size;
    size.poses = 150;
    size.circles = 2.2;
    GraphWorld world(seed, size);
    const FactorGraph graph = driveOnline(world, 15);
    const double before = positionError(world.truth, [&](auto k) { return world.odometry[k]; });
    const double after = positionError(world.truth, [&](auto k) { return graph.pose(k); });
    EXPECT_LT(after, 0.75 * before) << "odometry " << before << " m";
    const std::size_t last = world.truth.size() - 1;
    EXPECT_LT(
        graph.pose(last).distanceTo(world.truth[last]),
        world.odometry[last].distanceTo(world.truth[last]));
  }
}

TEST(FactorGraph, ViewsOfAPoseThatStaysCountHoweverLateTheyCome)
{
  const auto drive = [](bool late)
  {
    GraphWorld world(6);
    FactorGraph graph(plain());
    graph.addPose(world.odometry[0]);
    if (late) graph.optimiseWindow(1);
    EXPECT_GT(world.addViews(graph, 0), 0u);
    graph.optimiseWindow(1);
    for (std::size_t k = 1; k < 8; ++k)
    {
      world.add(graph, k, graph.pose(k - 1) + (world.odometry[k] - world.odometry[k - 1]));
      graph.optimiseWindow(1);
    }
    return graph;
  };
  const FactorGraph late = drive(true), inTime = drive(false);
  for (std::size_t k = 0; k < late.poses(); ++k)
    EXPECT_EQ(late.pose(k).distanceTo(inTime.pose(k)), 0) << k;
  FactorGraph graph = late;
  EXPECT_THROW(graph.removeViews(0), std::invalid_argument) << "they are in the objects";
  EXPECT_NO_THROW(graph.removeViews(1));
}

TEST(FactorGraph, MarginalsOfAWindowKnowTheViewsBeforeIt)
{
  // Pose 0 is fixed either way; whether its views are folded yet is nothing to the covariance.
  GraphWorld world(8);
  FactorGraph graph(plain());
  for (std::size_t k = 0; k < 3; ++k) world.add(graph, k, world.odometry[k]);
  const auto all = graph.marginals(0, true), window = graph.marginals(1, true);
  EXPECT_LT((window.lastPose - all.lastPose).norm(), 1e-9 * all.lastPose.norm());
  ASSERT_EQ(window.objects.size(), all.objects.size());
  for (const auto& [id, covariance] : all.objects)
    EXPECT_LT((window.objects.at(id) - covariance).norm(), 1e-9 * covariance.norm()) << id;
}

TEST(FactorGraph, AnHeirTakesViewsOver)
{
  GraphWorld world(9);
  FactorGraph graph = world.graph(plain());
  const std::size_t views = graph.viewCount(), objects = graph.optimise().freeObjects;
  const Ellipsoid first = graph.object(1);
  graph.setObject(100, first, world.label());
  graph.removeObject(1, 100);
  EXPECT_EQ(graph.viewCount(), views);
  EXPECT_FALSE(graph.hasObject(1));
  graph.removeObject(100);
  EXPECT_LT(graph.viewCount(), views);
  EXPECT_EQ(graph.optimise().freeObjects, objects - 1);
}

TEST(FactorGraph, AnHeirKnowsWhatFoldedViewsSaid)
{
  constexpr ObjectId kHeir = 100;
  constexpr std::size_t kFirstFree = 57;  // object 1 is in view when the circle closes
  const auto run = [&](double heirYaw, ObjectId seen)
  {
    GraphWorld world(9);
    FactorGraph graph = world.graph(plain());
    graph.optimise();
    graph.optimiseWindow(kFirstFree);
    if (seen == kHeir)
    {
      const Ellipsoid known = graph.object(1);
      const Eigen::Vector3d half = known.semiAxes();
      const bool swap = heirYaw != 0;
      graph.setObject(
          kHeir,
          Ellipsoid(
              known.pose() + mrpt::poses::CPose3D(0, 0, 0, heirYaw, 0, 0),
              swap ? Eigen::Vector3d(half.y(), half.x(), half.z()) : half),
          world.label());
      graph.removeObject(1, kHeir);
    }
    return graph.marginals(kFirstFree, true).objects.at(seen);
  };
  const Eigen::MatrixXd before = run(0, 1);
  EXPECT_LT((run(0, kHeir) - before).cwiseAbs().maxCoeff(), 1e-6 * before.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd turned = run(M_PI / 2, kHeir);
  EXPECT_NEAR(turned(4, 4), before(5, 5), 1e-6) << "its axes have each other's names";
  EXPECT_NEAR(turned(0, 0), before(0, 0), 1e-6);
}
