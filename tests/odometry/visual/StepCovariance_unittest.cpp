#include "visual/StepCovariance.h"

#include <gtest/gtest.h>

#include <random>

#include "../../geometry/Algebra.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
Vector6 sample(const Matrix6& covariance, std::mt19937& random)
{
  std::normal_distribution<double> normal;
  const Matrix6 root = rootOf(covariance);
  return root * Vector6::NullaryExpr([&](auto) { return normal(random); });
}

Matrix6 someCovariance(unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 0.004);
  const Matrix6 root = Matrix6::NullaryExpr([&](auto, auto) { return normal(random); });
  return root * root.transpose();
}
}  // namespace

TEST(StepCovariance, BecomesThatOfMrptsCoordinates)
{
  const CPose3D pose(0.4, -0.2, 0.3, 0.7, -0.4, 0.5);
  const Matrix6 covariance = someCovariance(1);
  const auto gaussian = gaussianOf(isometryOf(pose), covariance);
  EXPECT_LT((gaussian.mean.asVectorVal() - pose.asVectorVal()).norm(), 1e-9);
  std::mt19937 random(2);
  constexpr int kSamples = 20000;
  Matrix6 sum = Matrix6::Zero();
  for (int i = 0; i < kSamples; ++i)
  {
    const auto moved = poseOf(smallMotion(sample(covariance, random)) * isometryOf(pose));
    const Vector6 error = moved.asVectorVal().asEigen() - pose.asVectorVal().asEigen();
    sum += error * error.transpose();
  }
  const Matrix6 sampled = sum / kSamples;
  // Entries are sampled to about 1 % of the variances involved
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      EXPECT_NEAR(
          gaussian.cov(i, j), sampled(i, j), 0.04 * std::sqrt(sampled(i, i) * sampled(j, j)))
          << i << "," << j;
}

TEST(StepCovariance, IsFiniteWhenTheStepTurnsStraightDown)
{
  const auto gaussian = gaussianOf(isometryOf(CPose3D(0, 0, 0, 0, M_PI / 2, 0)), someCovariance(3));
  EXPECT_TRUE(gaussian.cov.asEigen().allFinite());
}

TEST(StepCovariance, AdjointCarriesMotionsBetweenFrames)
{
  const Eigen::Isometry3d T = isometryOf(CPose3D(1, -2, 0.5, 0.3, -0.8, 1.1));
  const Vector6 x = 1e-5 * (Vector6() << 1, -2, 3, 2, 1, -1).finished();
  const Eigen::Matrix4d there = (T * smallMotion(x)).matrix();
  const Eigen::Matrix4d here = (smallMotion(adjoint(T) * x) * T).matrix();
  EXPECT_LT((there - here).norm(), 1e-8) << "second order terms of 1e-5 motions are left";
}

TEST(StepCovariance, AddsUpFromMarkToMark)
{
  const Matrix6 one = Matrix6::Identity();
  StepCovariance uncertainty;
  uncertainty.setLatest(2 * one);
  uncertainty.take();  // marked, with the error 2 against its keyframe
  uncertainty.setLatest(3 * one);
  EXPECT_EQ(uncertainty.take(), 5 * one) << "both ends err against the same keyframe";
  uncertainty.setLatest(4 * one);
  uncertainty.addKeyframe(4 * one);
  uncertainty.addKeyframe(7 * one);
  uncertainty.setLatest(one);
  EXPECT_EQ(uncertainty.take(), (3 + 4 + 7 + 1) * one);
  EXPECT_EQ(uncertainty.take(), 2 * one);
}
