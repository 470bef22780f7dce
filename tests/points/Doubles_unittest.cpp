#include "Doubles.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

namespace
{
/** A map of which the objects 0..n-1 were mapped before the robot drifted, and the others after it.
 * The latter are all displaced by one shift. */
DoublesProblem driftedMap(
    const std::vector<std::pair<Eigen::Vector2d, std::string>>& before,
    const std::vector<std::pair<Eigen::Vector2d, std::string>>& after,
    double driftSigma)
{
  constexpr double kOwn = 0.05;  // [m]
  DoublesProblem problem;
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

TEST(Doubles, SeveralPairsTellWhatTheNearestDoesNot)
{
  // With a drift of (1.5, 0), chair 3 lies nearer to the wrong chair 1 than to its own, chair 0.
  const auto problem = driftedMap(
      {
          {  {0, 0}, "chair"},
          {{2.5, 0}, "chair"},
          {  {0, 3},   "cup"}
  },
      {{{1.5, 0}, "chair"}, {{1.5, 3}, "cup"}}, 1.0);
  const Doubles best = bestDoubles(problem);
  EXPECT_EQ(
      (Pairs{
          {0, 3},
          {2, 4}
  }),
      best.pairs);
  EXPECT_GT(best.logOdds, best.logOddsSecond);
}

TEST(Doubles, OnePairOfManyLikeObjectsIsUnsure)
{
  const auto problem = driftedMap(
      {
          {{0, 0}, "chair"},
          {{2, 0}, "chair"}
  },
      {{{1, 0}, "chair"}}, 1.0);
  const Doubles best = bestDoubles(problem);
  EXPECT_NEAR(best.logOdds, best.logOddsSecond, 0.1);
}

TEST(Doubles, OddsOfOnePairAreThoseOfItsDensity)
{
  auto problem = driftedMap(
      {
          {{0, 0}, "chair"}
  },
      {{{0.3, 0.4}, "chair"}}, 1.0);
  problem.leastSigma = 0;
  // Each of the two has the variance 0.05^2 of its own, and the second one also 1 for the drift.
  const double variance = 2 * 0.05 * 0.05 + 1.0;
  const double density = std::exp(-0.5 * 0.25 / variance) / (2 * M_PI * variance);
  const double labels = labelLogOdds(
      {
          {"chair", 5}
  },
      {{"chair", 5}}, 0.1, 5);
  EXPECT_NEAR(std::log(density / 0.1) + labels, bestDoubles(problem).logOdds, 1e-9);
}

TEST(Doubles, ObjectsSeenTogetherAreTwo)
{
  auto problem = driftedMap(
      {
          {{0, 0}, "chair"}
  },
      {{{0.1, 0}, "chair"}}, 0.5);
  EXPECT_EQ(1u, bestDoubles(problem).pairs.size());
  problem.distinct.insert({0, 1});
  EXPECT_TRUE(bestDoubles(problem).pairs.empty());
}

TEST(Doubles, ThreeMapsOfOneObjectDoNotContradictEachOther)
{
  const auto problem = driftedMap(
      {
          {   {0, 0}, "chair"},
          {{0.05, 0}, "chair"},
          {{0, 0.05}, "chair"}
  },
      {}, 0.1);
  EXPECT_EQ(0.0, bestDoubles(problem).logOddsSecond);
}

TEST(Doubles, LabelOddsFollowFromDrawingOneByOne)
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
