#include "quadmap/slam/PoseUncertainty.h"

#include <gtest/gtest.h>
#include <mrpt/math/CMatrixFixed.h>

#include <Eigen/Dense>
#include <random>

using namespace quadmap;
using mrpt::poses::CPose3D;

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
}  // namespace

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
