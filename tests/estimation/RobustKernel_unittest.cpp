#include "quadmap/estimation/RobustKernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using quadmap::RobustKernel;

namespace
{
constexpr double kThreshold = 1.5;

std::vector<RobustKernel> kernels()
{
  return {
      RobustKernel::quadratic(), RobustKernel::huber(kThreshold), RobustKernel::cauchy(kThreshold),
      RobustKernel::inequality(kThreshold)};
}

constexpr double kResiduals[] = {-7.0, -1.6, -1.4, -0.01, 1e-14, 0.3, 1.49, 1.51, 4.0, 20.0};

}  // namespace

TEST(RobustKernel, WeightAndRootBelongToTheCost)
{
  constexpr double h = 1e-6, kWeight = 0.7;
  for (const auto& kernel : kernels())
    for (const double r : kResiduals)
    {
      const double slope = (kernel.cost(r + h) - kernel.cost(r - h)) / (2 * h);
      EXPECT_NEAR(kernel.weight(r) * r, slope, 1e-6) << r;
      EXPECT_NEAR(0.5 * kernel.root(r) * kernel.root(r), kernel.cost(r), 1e-12) << r;
      const auto row = kernel.row(r, kWeight);
      EXPECT_NEAR(0.5 * row.value * row.value, kWeight * kernel.cost(r), 1e-12) << r;
      EXPECT_NEAR(row.value * row.slope, kWeight * slope, 1e-6) << r;
    }
}

TEST(RobustKernel, KnownValues)
{
  const auto huber = RobustKernel::huber(kThreshold);
  EXPECT_EQ(huber.weight(0), 1);
  EXPECT_EQ(huber.weight(-1.5), 1);
  EXPECT_DOUBLE_EQ(huber.weight(3), 0.5);
  EXPECT_DOUBLE_EQ(huber.weight(-6), 0.25);
  EXPECT_DOUBLE_EQ(huber.cost(3), 1.5 * 3 - 0.5 * 1.5 * 1.5);
  EXPECT_DOUBLE_EQ(RobustKernel::cauchy(2).weight(2), 0.5);
  EXPECT_DOUBLE_EQ(RobustKernel::cauchy(2).cost(2), 2 * std::log(2));
  EXPECT_EQ(RobustKernel::quadratic().cost(-4), 8);
}

TEST(RobustKernel, AnInequalityThatHoldsCostsNothing)
{
  const auto kernel = RobustKernel::inequality(kThreshold);
  for (const double r : {-5.0, 0.0})
  {
    EXPECT_EQ(kernel.cost(r), 0);
    EXPECT_EQ(kernel.weight(r), 0);
    EXPECT_EQ(kernel.row(r, 1).value, 0);
    EXPECT_EQ(kernel.row(r, 1).slope, 0);
  }
}

TEST(RobustKernel, AnInequalityIsLikeCauchysKernelNearZeroAndBoundedFarAway)
{
  const auto kernel = RobustKernel::inequality(kThreshold);
  const auto cauchy = RobustKernel::cauchy(kThreshold);
  EXPECT_NEAR(kernel.weight(0.1), cauchy.weight(0.1), 2e-5);
  EXPECT_LT(kernel.cost(1e3), kThreshold * kThreshold);
  EXPECT_NEAR(kernel.cost(1e3), kThreshold * kThreshold, 1e-4);
  EXPECT_DOUBLE_EQ(kernel.weight(std::sqrt(2) * kThreshold), 0.25);
}
