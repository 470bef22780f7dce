#include "quadmap/estimation/Association.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "quadmap/estimation/Assignment.h"

using namespace quadmap;

namespace
{
AssociationTarget target(const Eigen::VectorXd& p, double sigma, unsigned m, const char* label)
{
  AssociationTarget t;
  t.position = p;
  t.covariance = sigma * sigma * Eigen::MatrixXd::Identity(p.size(), p.size());
  t.observations = m;
  t.labelCounts = {
      {label, m}
  };
  return t;
}

AssociationCandidate candidate(const Eigen::VectorXd& p, double sigma, const char* label)
{
  return {p, sigma * sigma * Eigen::MatrixXd::Identity(p.size(), p.size()), label, true};
}

double bruteForceCost(const Eigen::MatrixXd& cost)
{
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(cost.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  double best = std::numeric_limits<double>::infinity();
  do
  {
    double sum = 0;
    for (Eigen::Index r = 0; r < cost.rows(); ++r) sum += cost(r, columns[std::size_t(r)]);
    best = std::min(best, sum);
  } while (std::next_permutation(columns.begin(), columns.end()));
  return best;
}

}  // namespace

TEST(Assignment, IsAsGoodAsTryingAllPermutations)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-5, 5);
  for (const auto& [rows, columns] : {
           std::pair{1, 1},
           {1, 4},
           {3, 3},
           {4, 6},
           {6, 6},
           {2, 7}
  })
    for (int trial = 0; trial < 20; ++trial)
    {
      Eigen::MatrixXd cost(rows, columns);
      for (Eigen::Index i = 0; i < cost.size(); ++i) cost.data()[i] = uniform(random);
      const auto assigned = optimalAssignment(cost);
      double sum = 0;
      for (std::size_t r = 0; r < assigned.size(); ++r)
        sum += cost(Eigen::Index(r), Eigen::Index(assigned[r]));
      EXPECT_NEAR(sum, bruteForceCost(cost), 1e-9) << rows << "x" << columns;
      auto unique = assigned;
      std::sort(unique.begin(), unique.end());
      EXPECT_EQ(std::unique(unique.begin(), unique.end()), unique.end());
    }
}

TEST(Assignment, AvoidsForbiddenPairsWhenItCan)
{
  Eigen::MatrixXd cost(2, 3);
  cost << 0, kForbiddenCost, 5,  //
      1, kForbiddenCost, kForbiddenCost;
  EXPECT_EQ(optimalAssignment(cost), (std::vector<std::size_t>{2, 0}));
}

TEST(Assignment, RefusesWhatHasNoSolution)
{
  EXPECT_THROW(optimalAssignment(Eigen::MatrixXd::Zero(3, 2)), std::invalid_argument);
  Eigen::MatrixXd cost = Eigen::MatrixXd::Zero(1, 1);
  cost(0, 0) = std::nan("");
  EXPECT_THROW(optimalAssignment(cost), std::invalid_argument);
}

TEST(Association, PosteriorIsTheFormulaOfTheDesign)
{
  // One object and one measurement, computed by hand in 2-D and 3-D.
  for (const int dimension : {2, 3})
  {
    const Eigen::VectorXd at = Eigen::VectorXd::Constant(dimension, 1.0);
    Eigen::VectorXd seen = at;
    seen[0] += 0.2;
    AssociationParameters p;
    p.alpha = 0.7;
    p.beta = 0.4;
    p.labels = 10;
    p.newObjectVolume = 50;
    AssociationTarget t = target(at, 0.1, 5, "chair");
    t.labelCounts = {
        {"chair", 4},
        { "sofa", 1}
    };
    const auto d = associateFrame({candidate(seen, 0.1, "sofa")}, {t}, p);

    const double s2 = 0.02;  // 0.1^2 + 0.1^2
    const double gaussian = std::exp(-0.5 * 0.04 / s2) / std::pow(2 * M_PI * s2, 0.5 * dimension);
    const double join = 5 * (1 + 0.4) / (5 + 10 * 0.4) * gaussian;
    const double fresh = 0.7 / 10 / 50;
    ASSERT_EQ(d.size(), 1u);
    ASSERT_EQ(d[0].target, std::optional<std::size_t>(0));
    EXPECT_FALSE(d[0].startsObject);
    EXPECT_NEAR(d[0].logPosterior, std::log(join / (join + fresh)), 1e-12) << dimension;
    EXPECT_NEAR(d[0].logPosteriorSecond, std::log(fresh / (join + fresh)), 1e-12) << dimension;
  }
}

TEST(Association, AddsTheExtraLogLikelihood)
{
  const Eigen::Vector3d p(0, 0, 0);
  Eigen::MatrixXd extra(1, 1);
  extra << -std::numeric_limits<double>::infinity();
  const auto d = associateFrame({candidate(p, 0.1, "cup")}, {target(p, 0.1, 9, "cup")}, {}, extra);
  EXPECT_FALSE(d[0].target);
  EXPECT_TRUE(d[0].startsObject);
  EXPECT_NEAR(d[0].logPosterior, 0.0, 1e-12);
}

TEST(Association, NoTwoBoxesShareAnObject)
{
  // Both measurements prefer object 0; the best assignment as a whole gives the second one
  // object 1.
  const Eigen::Vector3d a(0, 0, 0), b(0.3, 0, 0);
  const auto d = associateFrame(
      {candidate(Eigen::Vector3d(0.02, 0, 0), 0.1, "cup"),
       candidate(Eigen::Vector3d(0.12, 0, 0), 0.1, "cup")},
      {target(a, 0.1, 9, "cup"), target(b, 0.1, 2, "cup")}, {});
  EXPECT_EQ(d[0].target, std::optional<std::size_t>(0));
  EXPECT_EQ(d[1].target, std::optional<std::size_t>(1));
  EXPECT_GT(d[1].logPosteriorSecond, d[1].logPosterior)
      << "alone it would have taken object 0: greedy would be wrong";
}

TEST(Association, FarMeasurementsStartAnObjectUnlessTheyMustNot)
{
  auto z = candidate(Eigen::Vector3d(3, 0, 0), 0.1, "cup");
  const auto t = target(Eigen::Vector3d(0, 0, 0), 0.1, 50, "cup");
  EXPECT_TRUE(associateFrame({z}, {t}, {})[0].startsObject);
  z.mayStartObject = false;
  const auto d = associateFrame({z}, {t}, {})[0];
  EXPECT_FALSE(d.startsObject);
  EXPECT_FALSE(d.target);
}

TEST(Association, GateDoesNotGrowWithoutBound)
{
  // Cups of 5 cm: with S = (6 cm)^2 the gate stays below half a metre however often one was seen.
  const Eigen::Vector3d p(0, 0, 0);
  for (const unsigned m : {1u, 10u, 50u, 1000u})
  {
    const auto d = associateFrame(
        {candidate(Eigen::Vector3d(0.5, 0, 0), 0.03, "cup")}, {target(p, 0.05, m, "cup")}, {});
    EXPECT_TRUE(d[0].startsObject) << m << " observations";
  }
}

TEST(Association, RejectsNonsense)
{
  const Eigen::Vector3d p(0, 0, 0);
  AssociationParameters bad;
  bad.alpha = 0;
  EXPECT_THROW(associateFrame({candidate(p, 1, "a")}, {}, bad), std::invalid_argument);
  EXPECT_THROW(
      associateFrame({candidate(p, 1, "a")}, {target(Eigen::Vector2d(0, 0), 1, 1, "a")}, {}),
      std::invalid_argument);
  EXPECT_THROW(
      associateFrame({candidate(p, 0, "a")}, {target(p, 0, 1, "a")}, {}), std::invalid_argument);
  EXPECT_THROW(
      associateFrame({candidate(p, 1, "a")}, {target(p, 1, 1, "a")}, {}, Eigen::MatrixXd(2, 2)),
      std::invalid_argument);
  EXPECT_TRUE(associateFrame({}, {target(p, 1, 1, "a")}, {}).empty());
}
