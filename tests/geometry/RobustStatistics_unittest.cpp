#include "quadmap/geometry/RobustStatistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "NotFinite.h"

using namespace quadmap;

TEST(Quantile, InterpolatesBetweenOrderStatistics)
{
  const std::vector<double> values{40, 10, 30, 20};
  EXPECT_DOUBLE_EQ(quantile(values, 0), 10);
  EXPECT_DOUBLE_EQ(quantile(values, 1), 40);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 25);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 17.5);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0 / 3), 20);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.3), 7);
}

TEST(Quantile, ARangeHasTheQuantilesAtBothEnds)
{
  std::mt19937 random(2);
  std::normal_distribution<double> gaussian;
  for (const std::size_t count : {1, 2, 31, 400, 1600})
  {
    std::vector<double> values(count);
    for (double& v : values) v = gaussian(random);
    values.push_back(kNaN);
    for (const double p : {0.0, 0.005, 0.02, 0.05, 0.3})
    {
      const QuantileRange range = quantileRange(values, p);
      EXPECT_EQ(range.low, quantile(values, p)) << p << " of " << count;
      EXPECT_EQ(range.high, quantile(values, 1 - p)) << p << " of " << count;
      EXPECT_EQ(range.width(), range.high - range.low);
    }
  }
  EXPECT_THROW(quantileRange({kNaN}, 0.1), std::invalid_argument);
}

TEST(Quantile, FarOutAgreesWithSortedValues)
{
  std::mt19937 random(1);
  std::normal_distribution<double> gaussian;
  for (const std::size_t count : {1, 2, 31, 64, 65, 1000, 5003})
  {
    std::vector<double> values(count);
    for (double& v : values) v = gaussian(random);
    auto sorted = values;
    std::sort(sorted.begin(), sorted.end());
    for (const double p :
         {0.0, 0.001, 0.005, 0.02, 0.03, 0.05, 0.5, 0.95, 0.97, 0.995, 0.9999, 1.0})
    {
      const double position = p * static_cast<double>(count - 1);
      const auto below = static_cast<std::size_t>(position);
      const double above = sorted[std::min(below + 1, count - 1)];
      const double share = position - static_cast<double>(below);
      EXPECT_NEAR(quantile(values, p), (1 - share) * sorted[below] + share * above, 1e-12)
          << p << " of " << count;
    }
  }
}

TEST(Quantile, OfAUniformSampleIsItsProbability)
{
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> values(20000);
  for (double& v : values) v = uniform(engine);
  for (double p : {0.02, 0.25, 0.5, 0.9, 0.98})
    EXPECT_NEAR(quantile(values, p), p, 0.015) << "4 sigma = 4 sqrt(p (1-p) / 20000) < 0.0142";
}

TEST(Quantile, LeavesOutValuesThatAreNotFinite)
{
  EXPECT_DOUBLE_EQ(quantile({kNaN, 1, kInf, 3, -kInf, 2}, 0.5), 2);
}

TEST(Quantile, RejectsNoValuesAndBadProbabilities)
{
  EXPECT_THROW(quantile({}, 0.5), std::invalid_argument);
  EXPECT_THROW(quantile({kNaN, kInf}, 0.5), std::invalid_argument);
  for (double p : {-0.1, 1.1, kNaN}) EXPECT_THROW(quantile({1, 2}, p), std::invalid_argument) << p;
}

TEST(Median, IsTheMiddleOfOddAndTheMeanOfTheMiddleTwoOfEvenCounts)
{
  EXPECT_DOUBLE_EQ(median({3, 1, 100}), 3);
  EXPECT_DOUBLE_EQ(median({3, 1, 100, 5}), 4);
}

TEST(MedianElement, IsTheUpperOneOfTheMiddleTwo)
{
  std::vector<float> odd{3, 1, 100}, even{3, 1, 100, 5};
  EXPECT_EQ(medianElement(odd), 3);
  EXPECT_EQ(medianElement(even), 5);
}

TEST(MadSigma, EstimatesTheSpreadOfNormalDataInSpiteOfOutliers)
{
  std::mt19937 engine(4);
  std::normal_distribution<double> normal(5, 0.2);
  std::vector<double> values(20000);
  for (double& v : values) v = normal(engine);
  EXPECT_NEAR(madSigma(values), 0.2, 0.01)
      << "standard error of the MAD: 1.17 sigma/sqrt(n) = 0.0017";
  for (std::size_t i = 0; i < 1000; ++i) values[i] = 1e6;
  EXPECT_NEAR(madSigma(values), 0.2, 0.02) << "5 % outliers shift it by about 6 %";
}
