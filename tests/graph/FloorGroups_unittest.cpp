#include "FloorGroups.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <random>

#include "quadmap/graph/FactorGraph.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
CPose3DPDFGaussian stepOf(double metres, double positionSigma, double angleSigma)
{
  CPose3DPDFGaussian step(CPose3D(metres, 0, 0, 0, 0, 0));
  for (int i = 0; i < 6; ++i) step.cov(i, i) = std::pow(i < 3 ? positionSigma : angleSigma, 2);
  return step;
}

/** A straight way along x with a pose each metre. */
HeightDrift straightWay(std::size_t poses, double positionSigma, double angleSigma)
{
  HeightDrift drift;
  const auto step = stepOf(1, positionSigma, angleSigma);
  for (std::size_t k = 0; k < poses; ++k)
    drift.add(Eigen::Vector2d(double(k), 0), k > 0 ? &step : nullptr);
  return drift;
}

StandingThing thing(double bottom, double sigma, std::vector<std::size_t> poses)
{
  const double x = double(poses.front());
  return {
      bottom, sigma * sigma, {x, 0},
          std::move(poses)
  };
}

}  // namespace

TEST(HeightDrift, IsThatOfSampledTrajectories)
{
  constexpr double kPosition = 0.02, kAngle = 0.01;
  constexpr int kPoses = 12, kFrom = 3, kTo = 11, kSamples = 4000;
  const Eigen::Vector2d place(14, 0);  // three metres ahead of the last pose
  const HeightDrift drift = straightWay(kPoses, kPosition, kAngle);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  double squares = 0;
  for (int sample = 0; sample < kSamples; ++sample)
  {
    CPose3D pose;  // of kTo in kFrom
    for (int k = kFrom + 1; k <= kTo; ++k)
      pose = pose + CPose3D(
                        1 + kPosition * normal(random), kPosition * normal(random),
                        kPosition * normal(random), kAngle * normal(random),
                        kAngle * normal(random), kAngle * normal(random));
    mrpt::math::TPoint3D seen;
    pose.composePoint({3, 0, 0}, seen);
    squares += seen.z * seen.z / kSamples;
  }
  EXPECT_NEAR(drift.variance(kFrom, kTo, place) / squares, 1.0, 0.07)
      << "three standard errors of a sampled variance";
  EXPECT_EQ(drift.variance(5, 5, place), 0);
}

TEST(HeightDrift, KnowsNothingAcrossAMissingStep)
{
  HeightDrift drift;
  const auto step = stepOf(1, 0.01, 0.001);
  drift.add({0, 0}, nullptr);
  drift.add({1, 0}, &step);
  drift.add({2, 0}, nullptr);
  EXPECT_LT(drift.variance(0, 1, {1, 0}), 1e-3);
  EXPECT_GT(drift.variance(1, 2, {2, 0}), 1e4);
}

TEST(FloorGroups, TellADaisFromTheFloorBesideIt)
{
  const HeightDrift drift = straightWay(10, 0.01, 0.002);
  const auto floors = floorsOf(
      {thing(0.01, 0.04, {1, 2}), thing(0.25, 0.04, {2, 3}), thing(-0.03, 0.04, {3, 4}),
       thing(0.27, 0.04, {3, 4})},
      drift);
  EXPECT_EQ(floors, (std::vector<std::size_t>{0, 1, 0, 1}));
}

TEST(FloorGroups, TellStoreysApartThoughTheWayUpDrifts)
{
  for (const double angleSigma : {0.002, 0.02})  // the latter: 3 m of height over 40 m
  {
    const HeightDrift drift = straightWay(100, 0.02, angleSigma);
    const auto floors = floorsOf(
        {thing(0, 0.04, {1, 2, 80}), thing(2.6, 0.04, {40}), thing(2.5, 0.04, {45}),
         thing(0.05, 0.04, {5})},
        drift);
    EXPECT_EQ(floors, (std::vector<std::size_t>{0, 1, 1, 0})) << angleSigma;
  }
}

TEST(FloorGroups, KeepOneFloorThatDriftBends)
{
  const HeightDrift drift = straightWay(100, 0.02, 0.002);  // 0.4 m of height over 60 m
  const auto floors =
      floorsOf({thing(0, 0.04, {0}), thing(0.1, 0.04, {30}), thing(0.3, 0.04, {60})}, drift);
  EXPECT_EQ(floors, (std::vector<std::size_t>{0, 0, 0}));
  EXPECT_EQ(floorsOf({thing(0, 0.04, {0, 60}), thing(0.3, 0.04, {60})}, drift)[1], 1U)
      << "what one pose sees does not drift";
}

TEST(FloorGroups, LetABottomThatNobodySawJoinTheNearestFloor)
{
  const HeightDrift drift = straightWay(10, 0.01, 0.002);
  const auto floors = floorsOf(
      {thing(0.5, 0.3, {2}), thing(0, 0.04, {1}), thing(2.6, 0.04, {2}), thing(1.9, 0.3, {3})},
      drift);
  EXPECT_EQ(floors[0], floors[1]);
  EXPECT_EQ(floors[3], floors[2]);
  EXPECT_NE(floors[1], floors[2]);
  EXPECT_TRUE(floorsOf({}, drift).empty());
}

namespace
{
LabelProperties chair()
{
  LabelProperties label;
  label.typicalSize = {0.5, 0.5, 0.8};
  label.sizeSpread = 0.2;
  label.support = UsualSupport::Floor;
  return label;
}

/** A chair whose six faces were measured, as seen from the robot at (0, 0, robotHeight). */
BoxMeasurement seenChair(double x, double y, double bottom, double robotHeight)
{
  BoxMeasurement view;
  view.complete = true;
  view.center = {x, y, bottom + 0.4 - robotHeight};
  view.halfSizes = {0.25, 0.25, 0.4};
  for (auto& face : view.faces) face = {FaceKind::Measured, 0.02};
  view.faces.back().kind = FaceKind::Support;
  return view;
}

}  // namespace

TEST(FactorGraph, DoesNotPullStoreysAndPlatformsTogether)
{
  for (const double upper : {0.25, 2.6})
  {
    FactorGraph graph((FactorGraphOptions()));
    constexpr std::size_t kPoses = 6;
    for (std::size_t k = 0; k < kPoses; ++k)
    {
      const double height = upper * double(k) / (kPoses - 1);  // the robot climbs
      graph.addPose(CPose3D(0, 0, height, 0, 0, 0));
      if (k == 0) continue;
      auto step = stepOf(0, 0.02, 0.01);
      step.mean.z(upper / (kPoses - 1));
      graph.addStep(k - 1, k, step);
    }
    ObjectId id = 0;
    for (const double bottom : {0.0, 0.0, upper, upper})
    {
      const double x = 2, y = double(id) - 1.5;
      graph.setObject(
          ++id, Ellipsoid(CPose3D(x, y, bottom + 0.4, 0, 0, 0), {0.25, 0.25, 0.4}), chair());
      const std::size_t first = bottom > 0 ? kPoses - 2 : 0;
      for (std::size_t k = first; k < first + 2; ++k)
        graph.addView(k, id, seenChair(x, y, bottom, graph.pose(k).z()));
    }
    for (const bool online : {true, false})
    {
      if (online)
        graph.optimiseWindow(1);
      else
        graph.optimise();
      const auto bottom = [&](ObjectId o)
      { return graph.object(o).center().z() - graph.object(o).semiAxes().z(); };
      EXPECT_NEAR(bottom(1), 0, 0.005) << upper;
      EXPECT_NEAR(bottom(4), upper, 0.005) << "not drawn to the other floor";
      EXPECT_NEAR(graph.pose(kPoses - 1).z(), upper, 0.005);
    }
  }
}
