#include "quadmap/estimation/MapObject.h"

#include <gtest/gtest.h>

#include <random>

#include "../geometry/Algebra.h"

using namespace quadmap;

namespace
{
/** A covariance with errors of different sizes along directions of its own. */
UprightCovariance drawn(std::mt19937& random)
{
  std::normal_distribution<double> gauss;
  UprightCovariance A;
  for (double& value : A.reshaped()) value = gauss(random);
  return A * A.transpose() + 0.1 * UprightCovariance::Identity();
}

/** Whether a - b has no negative eigenvalue, but for rounding. */
bool isAtLeast(const UprightCovariance& a, const UprightCovariance& b)
{
  return eigenvaluesOf(a - b)[0] > -1e-9;
}
}  // namespace

TEST(CovarianceIntersection, TwoEqualOnesKnowNoMoreThanOne)
{
  std::mt19937 random(1);
  const UprightCovariance C = drawn(random);
  EXPECT_LT((covarianceIntersection(C, C) - C).norm(), 1e-9);
}

TEST(CovarianceIntersection, TakesTheBetterOneOfTwo)
{
  std::mt19937 random(2);
  const UprightCovariance C = drawn(random), worse = 4 * C;
  EXPECT_LT((covarianceIntersection(C, worse) - C).norm(), 1e-9);
  EXPECT_LT((covarianceIntersection(worse, C) - C).norm(), 1e-9);
}

TEST(CovarianceIntersection, ClaimsNoMoreThanIndependentOnesNorLessThanEither)
{
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i)
  {
    const UprightCovariance a = drawn(random), b = drawn(random);
    const UprightCovariance both = covarianceIntersection(a, b);
    EXPECT_TRUE(isAtLeast(both, inverseOf(inverseOf(a) + inverseOf(b))));
    EXPECT_LE(determinantOf(both), std::min(determinantOf(a), determinantOf(b)) * (1 + 1e-9));
  }
}

TEST(CovarianceIntersection, HoldsHoweverTheErrorsAreCorrelated)
{
  // Whatever the correlation, the weighted mean errs by no more than is claimed (Julier, Uhlmann).
  std::mt19937 random(4);
  const UprightCovariance a = drawn(random), b = drawn(random);
  const UprightCovariance both = covarianceIntersection(a, b);
  const UprightCovariance rootA = rootOf(a), rootB = rootOf(b);
  // The share of a in (share A + (1 - share) B)^-1, from the traces.
  const UprightCovariance A = inverseOf(a), B = inverseOf(b);
  const double share = (inverseOf(both) - B).trace() / (A - B).trace();
  for (int i = 0; i < 20; ++i)
  {
    const UprightCovariance Q = orthogonalOf(drawn(random));
    const UprightCovariance cross = rootA * Q * rootB.transpose();  // fully correlated
    const UprightCovariance Ka = share * both * A, Kb = (1 - share) * both * B;
    const UprightCovariance error = Ka * a * Ka.transpose() + Kb * b * Kb.transpose() +
                                    Ka * cross * Kb.transpose() +
                                    (Ka * cross * Kb.transpose()).transpose();
    EXPECT_TRUE(isAtLeast(both, error));
  }
}
