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
/** A Gaussian position of something that has a label: an object, or what was seen. */
struct Thing
{
  Eigen::VectorXd position;  // [m]
  double sigma;              // [m]
  const char* label;
  unsigned observations = 1;
  bool mayStart = true;
};

/** Assigns what was seen to objects by how far they are from each other. */
std::vector<AssociationDecision> associate(
    const std::vector<Thing>& seen,
    const std::vector<Thing>& objects,
    const AssociationParameters& parameters = {})
{
  std::vector<AssociationCandidate> candidates;
  std::vector<AssociationTarget> targets;
  Eigen::MatrixXd log(Eigen::Index(seen.size()), Eigen::Index(objects.size()));
  for (const Thing& o : objects) targets.push_back({o.observations, {{o.label, o.observations}}});
  for (const Thing& z : seen)
  {
    const auto row = Eigen::Index(candidates.size());
    candidates.push_back({z.label, z.mayStart});
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
      const double variance = z.sigma * z.sigma + objects[i].sigma * objects[i].sigma;
      const auto n = z.position.size();
      log(row, Eigen::Index(i)) =
          logGaussian(z.position - objects[i].position, variance * Eigen::MatrixXd::Identity(n, n));
    }
  }
  return associateFrame(candidates, targets, parameters, log);
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
    const AssociationTarget object{
        5, {{"chair", 4}, {"sofa", 1}}
    };
    const Eigen::MatrixXd S = 0.02 * Eigen::MatrixXd::Identity(dimension, dimension);
    Eigen::MatrixXd log(1, 1);
    log << logGaussian(seen - at, S);
    const auto d = associateFrame(
        {
            {"sofa", true}
    },
        {object}, p, log);

    const double s2 = 0.02;
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

TEST(Association, AForbiddenPairIsNone)
{
  Eigen::MatrixXd log(1, 1);
  log << -std::numeric_limits<double>::infinity();
  const auto d = associateFrame(
      {
          {"cup", true}
  },
      {{9, {{"cup", 9}}}}, {}, log);
  EXPECT_FALSE(d[0].target);
  EXPECT_TRUE(d[0].startsObject);
  EXPECT_NEAR(d[0].logPosterior, 0.0, 1e-12);
}

TEST(Association, NoTwoBoxesShareAnObject)
{
  // Both measurements prefer object 0; the best assignment as a whole gives the second one
  // object 1.
  const Eigen::Vector3d a(0, 0, 0), b(0.3, 0, 0);
  const auto d = associate(
      {
          {Eigen::Vector3d(0.02, 0, 0), 0.1, "cup"},
          {Eigen::Vector3d(0.12, 0, 0), 0.1, "cup"}
  },
      {{a, 0.1, "cup", 9}, {b, 0.1, "cup", 2}});
  EXPECT_EQ(d[0].target, std::optional<std::size_t>(0));
  EXPECT_EQ(d[1].target, std::optional<std::size_t>(1));
  EXPECT_GT(d[1].logPosteriorSecond, d[1].logPosterior)
      << "alone it would have taken object 0: greedy would be wrong";
}

TEST(Association, FarMeasurementsStartAnObjectUnlessTheyMustNot)
{
  Thing z{Eigen::Vector3d(3, 0, 0), 0.1, "cup"};
  const Thing object{Eigen::Vector3d(0, 0, 0), 0.1, "cup", 50};
  EXPECT_TRUE(associate({z}, {object})[0].startsObject);
  z.mayStart = false;
  const auto d = associate({z}, {object})[0];
  EXPECT_FALSE(d.startsObject);
  EXPECT_FALSE(d.target);
}

TEST(Association, GateDoesNotGrowWithoutBound)
{
  // Cups of 5 cm: with S = (6 cm)^2 the gate stays below half a metre however often one was seen.
  for (const unsigned m : {1u, 10u, 50u, 1000u})
  {
    const auto d = associate(
        {
            {Eigen::Vector3d(0.5, 0, 0), 0.03, "cup"}
    },
        {{Eigen::Vector3d(0, 0, 0), 0.05, "cup", m}});
    EXPECT_TRUE(d[0].startsObject) << m << " observations";
  }
}

TEST(Association, RejectsNonsense)
{
  const Thing thing{Eigen::Vector3d(0, 0, 0), 1, "a"};
  AssociationParameters bad;
  bad.alpha = 0;
  EXPECT_THROW(associate({thing}, {}, bad), std::invalid_argument);
  EXPECT_THROW(
      logGaussian(Eigen::Vector3d(0, 0, 0), Eigen::Matrix3d::Zero()), std::invalid_argument);
  EXPECT_THROW(
      associateFrame(
          {
              {"a", true}
  },
          {{1, {{"a", 1}}}}, {}, Eigen::MatrixXd(2, 2)),
      std::invalid_argument);
  EXPECT_TRUE(associate({}, {thing}).empty());
}
