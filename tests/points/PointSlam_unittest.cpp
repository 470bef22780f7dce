#include "quadmap/points/PointSlam.h"

#include <gtest/gtest.h>

#include "PointWorld.h"

using namespace quadmap;

namespace
{
PointOptions given()
{
  PointOptions options;
  options.associationGiven = true;
  return options;
}

template <int D>
double drift(const PointWorld<D>& world)
{
  double farthest = 0;
  const auto drifted = world.drifted();
  for (std::size_t k = 0; k < drifted.size(); ++k)
    farthest = std::max(farthest, (drifted[k].t - world.truth[k].t).norm());
  return farthest;
}

/** Worlds of fifteen objects with five labels, with 5 % of the labels flipped, 10 % of the objects
 * missed, and 25 % clutter. They have the random seeds 1, 2, ... of which the odometry drifts by
 * more than a metre. */
template <int D>
void expectHardCaseIsSolved(unsigned seeds, bool viewKnown)
{
  constexpr double kMinDrift = 1.0;  // [m]
  PointScore score;
  double error = 0, errorKnown = 0;
  unsigned hard = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed)
  {
    const PointWorld<D> world(seed);
    if (drift<D>(world) < kMinDrift) continue;
    ++hard;
    PointVisibility<D> visible;
    if (viewKnown)
      visible = [&](const PointVector<D>& p, std::size_t) { return world.isInView(p); };
    const auto found = world.solve({}, true, visible);
    score += scoreOf<D>(found, world);
    error += trajectoryError<D>(found.poses, world.truth);
    errorKnown += trajectoryError<D>(world.solve(given()).poses, world.truth);
  }
  EXPECT_GE(2 * hard, seeds) << "too few worlds are hard";
  EXPECT_GE(score.precision(), 0.97);
  EXPECT_GE(score.recall(), 0.97);
  EXPECT_LE(error, 1.05 * errorKnown);
}

}  // namespace

TEST(PointSlam, SolvesTheHardCaseInThePlane) { expectHardCaseIsSolved<2>(8, false); }

TEST(PointSlam, SolvesTheHardCaseInThePlaneWithAKnownView) { expectHardCaseIsSolved<2>(8, true); }

TEST(PointSlam, SolvesTheHardCaseInSpace) { expectHardCaseIsSolved<3>(6, false); }

TEST(PointSlam, WhatWasSeenOnceMovesWithACorrection)
{
  const PointWorld<2> world(2);
  PointSlam<2> slam({});
  std::vector<PointPose<2>> before;
  std::size_t compared = 0;
  for (std::size_t k = 0; k < world.truth.size(); ++k)
  {
    slam.addFrame(world.odometry[k], world.detections[k], world.truth.front());
    const auto now = slam.result();
    bool isCorrected = false;  // only a closed loop makes it estimate all poses anew
    for (std::size_t i = 0; i < before.size(); ++i)
      isCorrected |= (now.poses[i].t - before[i].t).norm() > 0.01;
    before = now.poses;
    for (std::size_t i = 0; isCorrected && i <= k; ++i)
      for (std::size_t m = 0; m < now.decisions[i].size(); ++m)
      {
        const auto& object = now.decisions[i][m].object;
        if (!object || now.objects[*object].observations != 1) continue;
        const Eigen::Vector2d shown = now.poses[i] * world.detections[i][m].position;
        EXPECT_LT((shown - now.objects[*object].position).norm(), 1e-3) << "frame " << k;
        ++compared;
      }
  }
  EXPECT_GT(compared, 10u);
}

TEST(PointSlam, AMeasurementIsNoEvidenceForItself)
{
  PointMeasurement<2> z;
  z.position = {2, 0};
  z.covariance = 0.01 * Eigen::Matrix2d::Identity();
  PointSlam<2> slam({}, true);
  for (const auto* label : {"chair", "chair", "chair", "table"})
  {
    z.label = label;
    slam.addFrame({}, {z});
  }
  slam.finish();
  const auto found = slam.result();
  ASSERT_EQ(found.objects.size(), 1u);
  const auto odds = [&](std::size_t k)
  { return found.decisions[k][0].logPosterior - found.decisions[k][0].logPosteriorSecond; };
  // Only the labels differ: of three other observations two or none had this one.
  const double beta = PointOptions().beta;
  EXPECT_NEAR(odds(1) - odds(3), std::log((2 + beta) / (0 + beta)), 1e-9);
}

TEST(PointSlam, ObjectsAndPosesKnowHowWrongTheyAre)
{
  double sum = 0;
  int n = 0;
  for (const unsigned seed : {1u, 2u, 3u})
  {
    const PointWorld<2> world(seed);
    const auto found = world.solve(given());
    for (const auto& object : found.objects)
    {
      const Eigen::Vector2d e = object.position - world.objects[*object.instance];
      sum += squaredError(e, object.covariance);
      n += 2;
    }
  }
  // Chi squared over its degrees of freedom; the errors of one world are correlated.
  EXPECT_GT(sum / n, 0.3);
  EXPECT_LT(sum / n, 3.0);
}

TEST(PointSlam, OnlineResultNeedsNoEnd)
{
  const PointWorld<2> world(2);
  const auto online = world.solve({}, false);
  EXPECT_EQ(world.truth.size(), online.poses.size());
  EXPECT_EQ(0, online.rounds);
  EXPECT_LT((online.poses.back().t - world.truth.back().t).norm(), 0.5 * drift<2>(world));
}

TEST(PointSlam, GivenAssociationsAreKept)
{
  const PointWorld<2> world(7);
  const auto found = world.solve(given());
  for (std::size_t k = 0; k < found.decisions.size(); ++k)
    for (std::size_t m = 0; m < found.decisions[k].size(); ++m)
    {
      const auto& instance = world.detections[k][m].instance;
      const auto& object = found.decisions[k][m].object;
      ASSERT_EQ(instance.has_value(), object.has_value());
      if (object)
      {
        EXPECT_EQ(instance, found.objects[*object].instance);
      }
    }
}

TEST(PointSlam, GivenPosesStay)
{
  const PointWorld<3> world(1);
  PointSlam<3> slam({}, true);
  for (std::size_t k = 0; k < 100; ++k)
  {
    PointOdometry<3> step = world.odometry[k];
    if (k > 0) step.T_from_to = world.truth[k - 1].inverse() * world.truth[k];
    slam.addFrame(step, world.detections[k], world.truth.front());
  }
  slam.finish();
  const auto found = slam.result();
  for (std::size_t k = 0; k < found.poses.size(); ++k)
    EXPECT_LT((found.poses[k].t - world.truth[k].t).norm(), 1e-6);
}

TEST(PointSlam, NoTwoMeasurementsOfAFrameShareAnObject)
{
  const auto found = PointWorld<2>(4).solve({});
  for (const auto& decisions : found.decisions)
  {
    std::set<std::size_t> objects;
    for (const auto& d : decisions)
      if (d.object)
      {
        EXPECT_TRUE(objects.insert(*d.object).second);
      }
  }
}

TEST(PointSlam, SameInputGivesTheSameNumbers)
{
  const PointWorld<3> world(2);
  const auto a = world.solve({}), b = world.solve({});
  for (std::size_t k = 0; k < a.poses.size(); ++k) EXPECT_EQ(a.poses[k].t, b.poses[k].t);
}

TEST(PointSlam, NothingToSeeLeavesTheOdometry)
{
  PointWorldOptions empty;
  empty.poses = 20;
  empty.objects = 0;
  const PointWorld<2> world(1, empty);
  const auto found = world.solve({});
  EXPECT_TRUE(found.objects.empty());
  EXPECT_LT((found.poses.back().t - world.drifted().back().t).norm(), 1e-9);
}
