#include "quadmap/odometry/PoseUncertainty.h"

#include <gtest/gtest.h>
#include <mrpt/math/CMatrixFixed.h>

#include <Eigen/Dense>
#include <random>

#include "../geometry/Algebra.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
PoseUncertaintyOptions sampleOptions()
{
  PoseUncertaintyOptions options;
  options.sigmaPosition = 0.01;
  options.sigmaAngle = 0.02;
  options.sigmaPositionPerMetre = 0.03;
  options.sigmaAnglePerRadian = 0.04;
  options.sigmaAnglePerMetre = 0.05;
  return options;
}

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** A random covariance with correlations and standard deviations of 1 to 4 cm or half degrees. */
Matrix6 sampleCovariance(unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 0.01);
  const Matrix6 root = Matrix6::NullaryExpr([&](auto, auto) { return normal(random); });
  return root * root.transpose();
}

CPose3DPDFGaussian poseWith(const CPose3D& pose, const Matrix6& cov)
{
  CPose3DPDFGaussian result(pose);
  result.cov = cov;
  return result;
}

CPose3D perturbed(const CPose3DPDFGaussian& pose, std::mt19937& random)
{
  std::normal_distribution<double> normal;
  const Matrix6 root = rootOf(pose.cov.asEigen());
  auto v = pose.mean.asVectorVal();
  v.asEigen() += root * Eigen::Matrix<double, 6, 1>::NullaryExpr([&] { return normal(random); });
  return {v[0], v[1], v[2], v[3], v[4], v[5]};
}
}  // namespace

TEST(PoseUncertainty, SummedIncrementsGiveTheirCovarianceBack)
{
  const auto increment = poseWith(CPose3D(0.3, 0.1, -0.05, 0.2, 0.1, -0.1), sampleCovariance(1));
  auto from = poseWith(CPose3D(), sampleCovariance(2));
  for (int i = 0; i < 100; ++i) from += increment;  // lost by metres
  auto to = from;
  to += increment;
  const auto step = odometryStep(sampleOptions(), from, to);
  EXPECT_LT(
      (step.mean.asVectorVal().asEigen() - increment.mean.asVectorVal().asEigen()).norm(), 1e-9);
  // 1e-8 is what odometryStep() adds so that the covariance has an inverse
  EXPECT_LT((step.cov.asEigen() - increment.cov.asEigen()).cwiseAbs().maxCoeff(), 1.1e-8);
}

TEST(PoseUncertainty, LargeVariancesThatAreFullyCorrelatedHaveAnInverse)
{
  for (const double variance : {1e2, 1e6, 1e12})
  {
    const auto from = poseWith(CPose3D(), Matrix6::Constant(variance));
    const auto to = poseWith(CPose3D(0.1, 0, 0, 0.1, 0, 0), 2 * Matrix6::Constant(variance));
    const Matrix6 cov = odometryStep(sampleOptions(), from, to).cov.asEigen();
    EXPECT_EQ(cov.llt().info(), Eigen::Success) << variance;
    EXPECT_TRUE(cov.allFinite()) << variance;
  }
}

TEST(PoseUncertainty, AStepBackInTimeUndoesWhatWasAdded)
{
  const auto increment = poseWith(CPose3D(0.3, 0.1, -0.05, 0.2, 0.1, -0.1), sampleCovariance(1));
  auto from = poseWith(CPose3D(), sampleCovariance(2));
  for (int i = 0; i < 100; ++i) from += increment;
  auto to = from;
  to += increment;
  const auto back = odometryStep(sampleOptions(), to, from);
  std::mt19937 random(4);
  constexpr int kSamples = 20000;
  Matrix6 sum = Matrix6::Zero();
  for (int n = 0; n < kSamples; ++n)
  {
    const CPose3D sampled = CPose3D() - perturbed(increment, random);
    const Eigen::Matrix<double, 6, 1> error =
        sampled.asVectorVal().asEigen() - back.mean.asVectorVal().asEigen();
    sum += error * error.transpose();
  }
  const Matrix6 sampled = sum / kSamples;
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(back.cov(i, i), sampled(i, i), 0.05 * sampled(i, i)) << "coordinate " << i;
}

TEST(PoseUncertainty, PosesThatDoNotGetWorseErrIndependently)
{
  const Matrix6 cov = sampleCovariance(3);
  const auto from = poseWith(CPose3D(1, 2, 3, 0.5, 0.2, 0.1), cov);
  const auto to = poseWith(CPose3D(1.5, 1, 3.2, 0.9, 0.1, 0.3), cov);
  const auto step = odometryStep(sampleOptions(), from, to);
  std::mt19937 random(4);
  constexpr int kSamples = 20000;
  Matrix6 sum = Matrix6::Zero();
  for (int n = 0; n < kSamples; ++n)
  {
    const CPose3D sampled = perturbed(to, random) - perturbed(from, random);
    const Eigen::Matrix<double, 6, 1> error =
        sampled.asVectorVal().asEigen() - step.mean.asVectorVal().asEigen();
    sum += error * error.transpose();
  }
  const Matrix6 sampled = sum / kSamples;
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(step.cov(i, i), sampled(i, i), 0.05 * sampled(i, i)) << "coordinate " << i;
}

TEST(PoseUncertainty, WhatOdometryDoesNotStateIsAsTheOptionsSay)
{
  Matrix6 planar = Matrix6::Zero();
  planar(0, 0) = planar(1, 1) = 4e-4;
  planar(3, 3) = 1e-4;
  const auto increment = poseWith(CPose3D(0.5, 0, 0, 0.3, 0, 0), planar);
  auto to = increment;
  to += increment;
  const auto step = odometryStep(sampleOptions(), increment, to);
  const auto byOptions = odometryStep(sampleOptions(), increment.mean, to.mean);
  for (const int stated : {0, 1, 3})
    EXPECT_NEAR(step.cov(stated, stated), planar(stated, stated), 1.1e-8);
  for (const int silent : {2, 4, 5})
    EXPECT_EQ(step.cov(silent, silent), byOptions.cov(silent, silent));
  const auto mute = odometryStep(
      sampleOptions(), CPose3DPDFGaussian(increment.mean), CPose3DPDFGaussian(to.mean));
  EXPECT_EQ(mute.cov, byOptions.cov);
}

TEST(PoseUncertainty, GroundTruthStepHasTheErrorsOfBothEnds)
{
  const CPose3D from(1, 2, 3, 0.5, 0, 0), to(1, 2.5, 3, 0.5, 0, 0);
  const auto step = groundTruthStep(sampleOptions(), from, to);
  EXPECT_LT(
      (step.mean.asVectorVal().asEigen() - (to - from).asVectorVal().asEigen()).norm(), 1e-12);
  EXPECT_NEAR(step.cov(3, 3), 2 * 0.02 * 0.02, 1e-9);
  EXPECT_NEAR(step.cov(2, 2), 2 * 0.01 * 0.01 + 0.02 * 0.02 * 0.5 * 0.5, 1e-5) << "lever arm";
}

TEST(PoseUncertainty, StepGrowsWithDistanceAndAngle)
{
  const CPose3D from(1, 2, 0, 0.5, 0, 0), step(3, 0, 4, 0.3, 0, 0);
  const auto pdf = odometryStep(sampleOptions(), from, from + step);
  EXPECT_LT((pdf.mean.asVectorVal().asEigen() - step.asVectorVal().asEigen()).norm(), 1e-12);
  EXPECT_NEAR(std::sqrt(pdf.cov(0, 0)), 0.01 + 0.03 * 5, 1e-12);
  EXPECT_NEAR(std::sqrt(pdf.cov(4, 4)), 0.02 + 0.04 * 0.3 + 0.05 * 5, 1e-12);
  EXPECT_EQ(pdf.cov(0, 1), 0);
}

TEST(PoseUncertainty, GroundTruthPosesAreEquallyGood)
{
  PoseCovarianceChain chain(sampleOptions(), PoseSource::GroundTruth);
  chain.next(CPose3D());
  const auto pdf = chain.next(CPose3D(5, 0, 0, 1, 0, 0));
  EXPECT_NEAR(std::sqrt(pdf.cov(1, 1)), 0.01, 1e-12);
  EXPECT_NEAR(std::sqrt(pdf.cov(3, 3)), 0.02, 1e-12);
}

TEST(PoseUncertainty, OdometryErrorsAddUpAsSampledTrajectoriesDo)
{
  PoseUncertaintyOptions options = sampleOptions();
  options.sigmaAngle = 0.01;
  options.sigmaAnglePerMetre = 0;
  std::vector<CPose3D> poses;
  for (int i = 0; i < 6; ++i)
    poses.emplace_back(0.5 * i, 0.1 * i * i, 0.05 * i, 0.2 * i, 0.05 * i, 0);
  PoseCovarianceChain chain(options, PoseSource::Auto);
  EXPECT_TRUE(chain.next(poses[0]).cov.asEigen().isZero()) << "the first pose defines the map";
  mrpt::poses::CPose3DPDFGaussian last;
  for (std::size_t i = 1; i < poses.size(); ++i) last = chain.next(poses[i]);

  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  constexpr int kSamples = 20000;
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  for (int n = 0; n < kSamples; ++n)
  {
    CPose3D pose = poses[0];
    for (std::size_t i = 1; i < poses.size(); ++i)
    {
      const auto step = odometryStep(options, poses[i - 1], poses[i]);
      auto v = step.mean.asVectorVal();
      for (int k = 0; k < 6; ++k) v[k] += std::sqrt(step.cov(k, k)) * normal(random);
      pose = pose + CPose3D(v[0], v[1], v[2], v[3], v[4], v[5]);
    }
    const Eigen::Matrix<double, 6, 1> error =
        pose.asVectorVal().asEigen() - poses.back().asVectorVal().asEigen();
    sum += error * error.transpose();
  }
  const Eigen::Matrix<double, 6, 6> sampled = sum / kSamples;
  // 20,000 samples give variances to 1 %; linearisation costs about as much at these angles
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(last.cov(i, i), sampled(i, i), 0.05 * sampled(i, i)) << "coordinate " << i;
  EXPECT_LT(
      (last.mean.asVectorVal().asEigen() - poses.back().asVectorVal().asEigen()).norm(), 1e-9);
}
