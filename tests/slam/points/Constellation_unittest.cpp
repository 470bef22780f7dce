#include "quadmap/slam/points/Constellation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

namespace
{
/** Objects 0..n-1 were mapped before the robot drifted, the others after: all of those lie off by
 * one shift. */
ConstellationProblem driftedMap(
    const std::vector<std::pair<Eigen::Vector2d, std::string>>& before,
    const std::vector<std::pair<Eigen::Vector2d, std::string>>& after,
    double driftSigma)
{
  constexpr double kOwn = 0.05;  // [m]
  ConstellationProblem problem;
  for (const auto* part : {&before, &after})
    for (const auto& [position, label] : *part) problem.objects.push_back({position, {{label, 5}}});
  const auto n = 2 * static_cast<Eigen::Index>(problem.objects.size());
  const auto first = 2 * static_cast<Eigen::Index>(before.size());
  problem.covariance = kOwn * kOwn * Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = first; i < n; ++i)
    for (Eigen::Index j = first; j < n; ++j)
      if ((i - j) % 2 == 0) problem.covariance(i, j) += driftSigma * driftSigma;
  problem.density = 0.1;
  return problem;
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

}  // namespace

TEST(Constellation, SeveralPairsTellWhatTheNearestDoesNot)
{
  // Drift (1.5, 0): chair 3 lies nearer to the wrong chair 1 than to its own, 0.
  const auto problem = driftedMap(
      {
          {  {0, 0}, "chair"},
          {{2.5, 0}, "chair"},
          {  {0, 3},   "cup"}
  },
      {{{1.5, 0}, "chair"}, {{1.5, 3}, "cup"}}, 1.0);
  const Constellation best = bestConstellation(problem);
  EXPECT_EQ(
      (Pairs{
          {0, 3},
          {2, 4}
  }),
      best.pairs);
  EXPECT_GT(best.logOdds, best.logOddsSecond);
}

TEST(Constellation, OnePairOfManyLikeObjectsIsUnsure)
{
  const auto problem = driftedMap(
      {
          {{0, 0}, "chair"},
          {{2, 0}, "chair"}
  },
      {{{1, 0}, "chair"}}, 1.0);
  const Constellation best = bestConstellation(problem);
  EXPECT_NEAR(best.logOdds, best.logOddsSecond, 0.1);
}

TEST(Constellation, OddsOfOnePairAreThoseOfItsDensity)
{
  auto problem = driftedMap(
      {
          {{0, 0}, "chair"}
  },
      {{{0.3, 0.4}, "chair"}}, 1.0);
  problem.floorSigma = 0;
  // Written out: each of the two has 0.05^2 of its own, the second the drift's 1.
  const double variance = 2 * 0.05 * 0.05 + 1.0;
  const double density = std::exp(-0.5 * 0.25 / variance) / (2 * M_PI * variance);
  const double labels = labelLogOdds(
      {
          {"chair", 5}
  },
      {{"chair", 5}}, 0.1, 5);
  EXPECT_NEAR(std::log(density / 0.1) + labels, bestConstellation(problem).logOdds, 1e-9);
}

TEST(Constellation, ObjectsSeenTogetherAreTwo)
{
  auto problem = driftedMap(
      {
          {{0, 0}, "chair"}
  },
      {{{0.1, 0}, "chair"}}, 0.5);
  EXPECT_EQ(1u, bestConstellation(problem).pairs.size());
  problem.distinct.insert({0, 1});
  EXPECT_TRUE(bestConstellation(problem).pairs.empty());
}

TEST(Constellation, ThreeMapsOfOneObjectDoNotContradictEachOther)
{
  const auto problem = driftedMap(
      {
          {   {0, 0}, "chair"},
          {{0.05, 0}, "chair"},
          {{0, 0.05}, "chair"}
  },
      {}, 0.1);
  EXPECT_EQ(0.0, bestConstellation(problem).logOddsSecond);
}

TEST(Constellation, LabelOddsFollowFromDrawingOneByOne)
{
  // P(labels) as the product of each label's probability given those before it.
  const auto logSequence = [](const std::vector<int>& drawn)
  {
    constexpr double kBeta = 0.1, kLabels = 5;
    std::vector<double> counts(5, 0.0);
    double log = 0, n = 0;
    for (const int label : drawn)
    {
      log += std::log((counts[static_cast<std::size_t>(label)] + kBeta) / (n + kLabels * kBeta));
      counts[static_cast<std::size_t>(label)] += 1;
      n += 1;
    }
    return log;
  };
  const double expected =
      logSequence({0, 0, 1, 0, 0, 2}) - logSequence({0, 0, 1}) - logSequence({0, 0, 2});
  EXPECT_NEAR(
      expected,
      labelLogOdds(
          {
              {"a", 2},
              {"b", 1}
  },
          {{"a", 2}, {"c", 1}}, 0.1, 5),
      1e-9);
}
