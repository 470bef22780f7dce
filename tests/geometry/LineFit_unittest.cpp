#include "quadmap/geometry/LineFit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace quadmap;

namespace
{
/** Points of a line 1 m long, with noise across it that four neighbours share, as the pixels of a
 * depth image do, and some far from it. */
std::vector<Eigen::Vector2d> noisyLine(unsigned seed, double angle, double sigma, int outliers)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(-0.5, 0.5), far(0.2, 0.6);
  std::normal_distribution<double> across(0, sigma);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 100; ++i)
  {
    const double t = along(random), noise = across(random);
    for (int k = 0; k < 4; ++k)
      points.emplace_back(t + 1e-3 * k, 0.3 + (t + 1e-3 * k) * std::tan(angle) + noise);
  }
  for (int i = 0; i < outliers; ++i)
  {
    const double t = along(random);
    points.emplace_back(t, 0.3 + t * std::tan(angle) + far(random));
  }
  return points;
}

}  // namespace

TEST(LineFit, FindsTheAngleAndSaysHowWell)
{
  double squares = 0;
  constexpr int kLines = 200;
  for (unsigned seed = 0; seed < kLines; ++seed)
  {
    const auto line = fitLine(noisyLine(seed, 0.1, 0.004, 0), 0.02);
    ASSERT_TRUE(line);
    squares += std::pow(line->angle - 0.1, 2) / line->variance / kLines;
  }
  EXPECT_GT(squares, 0.6) << "of a mean squared error in variances, 1 expected";
  EXPECT_LT(squares, 1.6);
}

TEST(LineFit, LeavesOutWhatIsFarFromTheLine)
{
  const auto line = fitLine(noisyLine(1, -0.2, 0.004, 60), 0.02);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->angle, -0.2, 0.01);
  EXPECT_NEAR(line->share, 400.0 / 460, 0.03);
}

TEST(LineFit, NeedsPointsAndALength)
{
  EXPECT_FALSE(fitLine({}, 0.02));
  EXPECT_FALSE(fitLine(std::vector<Eigen::Vector2d>(200, {0.1, 0.2}), 0.02));
}
