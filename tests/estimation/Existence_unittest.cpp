#include "quadmap/estimation/Existence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "quadmap/estimation/LabelPrior.h"

using namespace quadmap;

TEST(Existence, ADetectionAndAMissAddTheLogRatiosOfTheirProbabilities)
{
  const ExistenceEvidence evidence(0.5, 0.1);
  EXPECT_DOUBLE_EQ(evidence.detection(), std::log(5));
  EXPECT_DOUBLE_EQ(evidence.miss(), std::log(0.5 / 0.9));
}

TEST(Existence, DetectionsAddUpToABound)
{
  ExistenceOptions options;
  EXPECT_DOUBLE_EQ(existenceAfterDetections(1, 0.5, options), 1 + 0.5 * std::log(5));
  EXPECT_EQ(existenceAfterDetections(options.maxLogOdds - 0.1, 1, options), options.maxLogOdds);
}

namespace
{
/** Sizes of an object in spreads from those of its label, and variances of their logarithms in
 * squared spreads. */
double evidenceOf(
    const Eigen::Vector3d& deviations,
    const Eigen::Vector3d& variances,
    const ExistenceOptions& options = {},
    bool isRound = false)
{
  LabelProperties label;
  label.known = true;
  label.dominantDirection = !isRound;
  label.typicalSize = {1.2, 0.4, 0.8};
  label.sizeSpread = 0.3;
  UprightCovariance covariance = UprightCovariance::Identity();
  for (Eigen::Index i = 0; i < 3; ++i) covariance(4 + i, 4 + i) = 0.09 * variances[i];
  const Eigen::Vector3d sizes =
      label.typicalSize.array() * (label.sizeSpread * deviations.array()).exp();
  return sizeEvidence(Ellipsoid({}, 0.5 * sizes), covariance, label, options, {});
}

double normalDensity(double x, double sigma)
{
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2 * M_PI));
}
}  // namespace

TEST(Existence, MeasuredSizesAreWeighedByTwoDensities)
{
  ExistenceOptions options;
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.5, -1, 0.2), Eigen::Vector3d(2, 1, -3)})
  {
    double real = 1, alarm = 1;
    for (Eigen::Index i = 0; i < 3; ++i)
    {
      real *= normalDensity(d[i], 1);
      alarm *= normalDensity(d[i], options.falseAlarmSpread);
    }
    const double odd = options.oddShare;
    EXPECT_NEAR(evidenceOf(d, {0, 0, 0}), std::log(((1 - odd) * real + odd * alarm) / alarm), 1e-9);
  }
}

TEST(Existence, SizesThatOnlyTheLabelTellsSayNothing)
{
  EXPECT_NEAR(evidenceOf({0, 0, 0}, {1, 1, 1}), 0, 1e-12);
  EXPECT_NEAR(evidenceOf({0, 3, 0}, {1, 2, 1}), 0, 1e-12);
  EXPECT_EQ(sizeEvidence(Ellipsoid(), UprightCovariance::Zero(), {}, {}, {}), 0) << "no label";
  ExistenceOptions alike;
  alike.falseAlarmSpread = 1;
  EXPECT_NEAR(evidenceOf({0, 1, 2}, {0, 0, 0}, alike), 0, 1e-12);
}

TEST(Existence, SizesCountAsFarAsTheyWereMeasured)
{
  ExistenceOptions options;
  options.oddShare = 1e-9;
  const double all = evidenceOf({0, 1, 0}, {1, 0, 1}, options);
  EXPECT_NEAR(all, std::log(normalDensity(1, 1) / normalDensity(1, 2)), 1e-6);
  EXPECT_NEAR(evidenceOf({0, 1, 0}, {1, 0.5, 1}, options), 0.5 * all, 1e-6);
}

TEST(Existence, WhatIsAsDeepAsWideHasOneWidth)
{
  ExistenceOptions options;
  options.oddShare = 1e-9;
  EXPECT_NEAR(
      evidenceOf({0.7, 0.7, 0}, {0, 0, 1}, options, true),
      std::log(normalDensity(0.7, 1) / normalDensity(0.7, 2)), 1e-6);
}

// An estimate of the label's prior alone, which for round things says that x and y are alike.
TEST(Existence, APriorAloneSaysNothing)
{
  LabelProperties label;
  label.known = true;
  label.typicalSize = {0.1, 0.1, 0.1};
  label.sizeSpread = 0.3;
  for (const bool isRound : {false, true})
  {
    label.dominantDirection = !isRound;
    UprightState x = UprightState::Zero();
    x.tail<3>().setConstant(std::log(0.05));
    NormalEquations equations;
    addLabelPrior(x, label, {}, equations);
    UprightCovariance covariance = UprightCovariance::Identity();
    covariance.bottomRightCorner<3, 3>() =
        Eigen::Matrix3d(equations.H.bottomRightCorner<3, 3>()).inverse();
    EXPECT_NEAR(sizeEvidence(ellipsoidOf(x), covariance, label, {}, {}), 0, 1e-9) << isRound;
  }
}

TEST(Existence, TheHorizontalSizesOfAnObjectHaveNoOrder)
{
  LabelProperties label;
  label.known = true;
  label.typicalSize = {1.2, 0.4, 0.8};
  const UprightCovariance sure = 1e-6 * UprightCovariance::Identity();
  const auto evidence = [&](double x, double y) {
    return sizeEvidence(Ellipsoid({}, {x, y, 0.4}), sure, label, {}, {});
  };
  EXPECT_DOUBLE_EQ(evidence(0.6, 0.2), evidence(0.2, 0.6));
  EXPECT_GT(evidence(0.2, 0.6), evidence(0.6, 0.6));
}

TEST(Existence, SizesNeverSayMoreAgainstAnObjectThanThatOddOnesAreRare)
{
  EXPECT_NEAR(evidenceOf({9, 9, 9}, {0, 0, 0}), std::log(ExistenceOptions().oddShare), 1e-9);
}

TEST(Existence, ABoxShowsAnObjectWhenItLiesInTheOutlineAndTheLabelsAgree)
{
  LabelTable labels;
  MapObject object;
  object.labelCounts["chair"] = 3;
  const ImageBox outline{100, 100, 200, 200};
  const ShownRule rule;
  const auto shows = [&](const ImageBox& box, const std::string& label)
  { return mayShow(box, label, object, outline, labels, rule); };
  EXPECT_TRUE(shows({110, 110, 190, 190}, "chair"));
  EXPECT_FALSE(shows({110, 110, 190, 190}, "spoon")) << "another label";
  EXPECT_FALSE(shows({110, 110, 130, 130}, "chair")) << "a speck in the outline";
  EXPECT_FALSE(shows({50, 50, 250, 250}, "chair")) << "three quarters of the box are outside";
  ShownRule anySize = rule;
  anySize.minInside = 0;
  EXPECT_TRUE(mayShow({50, 50, 250, 250}, "chair", object, outline, labels, anySize));
}
