#include "quadmap/slam/points/PointSlam.h"

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

/** Fifteen objects of five labels, odometry that drifts by more than a metre, 5 % of the labels
 * flipped, 10 % missed, 25 % clutter. */
template <int D>
void expectHardCaseIsSolved(const std::vector<unsigned>& seeds, bool viewKnown)
{
  PointScore score;
  double error = 0, errorKnown = 0;
  for (const unsigned seed : seeds)
  {
    const PointWorld<D> world(seed);
    ASSERT_GT(world.detectionCount(), 700u);
    ASSERT_GT(drift<D>(world), 1.0) << "seed " << seed;
    PointVisibility<D> visible;
    if (viewKnown)
      visible = [&](const PointVector<D>& p, std::size_t) { return world.isInView(p); };
    const auto found = world.solve({}, true, visible);
    score += scoreOf<D>(found, world);
    error += trajectoryError<D>(found.poses, world.truth);
    errorKnown += trajectoryError<D>(world.solve(given()).poses, world.truth);
  }
  EXPECT_GE(score.precision(), 0.97);
  EXPECT_GE(score.recall(), 0.97);
  EXPECT_LE(error, 1.05 * errorKnown);
}

}  // namespace

TEST(PointSlam, SolvesTheHardCaseInThePlane)
{
  expectHardCaseIsSolved<2>({2, 3, 4, 5, 6, 8}, false);
}

TEST(PointSlam, SolvesTheHardCaseInThePlaneWithAKnownView)
{
  expectHardCaseIsSolved<2>({9, 10, 11, 13}, true);
}

TEST(PointSlam, SolvesTheHardCaseInSpace) { expectHardCaseIsSolved<3>({1, 2, 3, 4, 5}, false); }

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
      sum += e.dot(object.covariance.inverse() * e);
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
