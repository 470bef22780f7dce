#include "observations/LogisticRegression.h"

#include <gtest/gtest.h>

#include <random>

namespace quadmap::observations
{
namespace
{
TEST(LogisticRegression, FindsTheWeightsThatMadeTheExamples)
{
  constexpr int kExamples = 20000;
  const Eigen::Vector3d truth(-2, 1.5, -0.7);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Eigen::MatrixXd x(kExamples, 3);
  Eigen::VectorXd y(kExamples);
  for (int i = 0; i < kExamples; ++i)
  {
    x.row(i) << 1, normal(random), 2 * normal(random);
    y[i] = uniform(random) < 1 / (1 + std::exp(-x.row(i).dot(truth))) ? 1 : 0;
  }
  const LogisticFit fit = fitLogistic(x, y);
  for (int j = 0; j < 3; ++j)
  {
    EXPECT_NEAR(fit.weights[j], truth[j], 4 * fit.sigmas[j]) << j;
    EXPECT_LT(fit.sigmas[j], 0.06) << j;
  }
}

TEST(LogisticRegression, RefusesWhatDoesNotDetermineTheWeights)
{
  const Eigen::MatrixXd x = Eigen::MatrixXd::Ones(5, 1);
  EXPECT_THROW(fitLogistic(x, Eigen::VectorXd::Zero(5)), std::runtime_error);
  EXPECT_THROW(fitLogistic(x, Eigen::VectorXd::Ones(5)), std::runtime_error);
  Eigen::MatrixXd never = Eigen::MatrixXd::Ones(4, 2);
  never.col(1).setZero();
  EXPECT_THROW(fitLogistic(never, Eigen::Vector4d(0, 1, 0, 1)), std::runtime_error);
  Eigen::MatrixXd apart(4, 2);
  apart << 1, -2, 1, -1, 1, 1, 1, 2;
  EXPECT_THROW(fitLogistic(apart, Eigen::Vector4d(0, 0, 1, 1)), std::runtime_error);
}

}  // namespace
}  // namespace quadmap::observations
