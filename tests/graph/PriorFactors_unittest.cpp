#include <random>

#include "../geometry/Algebra.h"
#include "FactorCheck.h"
#include "quadmap/geometry/RotationVector.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
const CPose3D kFrom(1, -2, 0.5, 2.5, 0.1, -0.2), kTo(1.1, -1.8, 0.4, 2.2, 0.2, -0.1);
const Ellipsoid kObject(CPose3D(1, 2, 0.8, -2.0, 0.3, 0.2), {0.3, 0.2, 0.9});

/** A full covariance of (x, y, z, yaw, pitch, roll). */
CPose3DPDFGaussian stepWithCovariance(const CPose3D& T_from_to, double scale)
{
  Eigen::Matrix<double, 6, 6> A;
  std::mt19937 random(7);
  std::normal_distribution<double> gauss;
  for (Eigen::Index i = 0; i < 36; ++i) A.data()[i] = gauss(random);
  CPose3DPDFGaussian step(T_from_to);
  step.cov = mrpt::math::CMatrixDouble66(
      scale * scale * (A * A.transpose() + Eigen::Matrix<double, 6, 6>::Identity()));
  return step;
}

LabelProperties label(bool dominant)
{
  LabelProperties p;
  p.typicalSize = {1.4, 0.9, 0.75};
  p.sizeSpread = 0.4;
  p.dominantDirection = dominant;
  return p;
}

ObjectPrior randomPrior(int size, ObjectFreedom freedom, int rank)
{
  std::mt19937 random(5);
  std::normal_distribution<double> gauss;
  Eigen::MatrixXd A(rank, size);
  for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = 3 * gauss(random);
  Eigen::VectorXd b(rank);
  for (Eigen::Index i = 0; i < rank; ++i) b[i] = gauss(random);
  return {objectBlockOf(kObject, freedom), A.transpose() * A, A.transpose() * b, 0};
}

}  // namespace

TEST(OdometryFactor, DerivativesAreThoseOfTheResiduals)
{
  const auto factor = createOdometryFactor(stepWithCovariance(kTo - kFrom, 0.1));
  const CPose3D elsewhere(1.2, -1.9, 0.3, 2.0, 0.3, -0.3);
  expectRightDerivatives(*factor, {poseBlock(kFrom), poseBlock(elsewhere)});
}

TEST(OdometryFactor, ResidualsOfSampledStepsAreWhite)
{
  // Steps drawn from the Gaussian over (x, y, z, yaw, pitch, roll), as MRPT defines it.
  const auto step = stepWithCovariance(CPose3D(0.3, -0.2, 0.1, 0.8, 0.4, -0.3), 0.004);
  const auto factor = createOdometryFactor(step);
  const Eigen::Matrix<double, 6, 6> L = rootOf(step.cov.asEigen());
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  constexpr int kSamples = 20000;
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  for (int k = 0; k < kSamples; ++k)
  {
    Eigen::Matrix<double, 6, 1> z;
    for (Eigen::Index i = 0; i < 6; ++i) z[i] = gauss(random);
    z = L * z;
    const CPose3D& m = step.mean;
    const CPose3D sampled(
        m.x() + z[0], m.y() + z[1], m.z() + z[2], m.yaw() + z[3], m.pitch() + z[4],
        m.roll() + z[5]);
    const Eigen::VectorXd r = residualsOf(*factor, {poseBlock(kFrom), poseBlock(kFrom + sampled)});
    covariance += r * r.transpose() / kSamples;
  }
  // Sampling error of an entry: 1 / sqrt(20000) = 0.007; linearisation 1 %.
  EXPECT_LT((covariance - Eigen::Matrix<double, 6, 6>::Identity()).cwiseAbs().maxCoeff(), 0.04)
      << covariance;
}

TEST(OdometryFactor, RejectsACovarianceThatIsNone)
{
  CPose3DPDFGaussian step(CPose3D(1, 0, 0, 0, 0, 0));
  step.cov.setZero();
  EXPECT_THROW(createOdometryFactor(step), std::invalid_argument);
}

TEST(LabelPrior, IsLogNormalInSizesOfEitherOrder)
{
  EstimatorOptions options;
  options.roundnessSigma = 0.1;
  for (const auto freedom : {ObjectFreedom::Upright, ObjectFreedom::Free})
  {
    const auto factor = createLabelPrior(label(true), options, freedom);
    expectRightDerivatives(*factor, {objectBlock(kObject, freedom)});
    for (const Eigen::Vector3d& half :
         {Eigen::Vector3d(0.7, 0.45, 0.375), Eigen::Vector3d(0.45, 0.7, 0.375)})
    {
      const Ellipsoid typical(CPose3D(), half);
      EXPECT_LT(residualsOf(*factor, {objectBlock(typical, freedom)}).norm(), 1e-12);
    }
    const Ellipsoid higher(CPose3D(), {0.7, 0.45, 0.375 * std::exp(0.4)});
    EXPECT_NEAR(residualsOf(*factor, {objectBlock(higher, freedom)})[2], 1.0, 1e-12);
    const auto round = createLabelPrior(label(false), options, freedom);
    EXPECT_NEAR(
        residualsOf(*round, {objectBlock(higher, freedom)})[3], std::log(0.7 / 0.45) / 0.1, 1e-9);
  }
}

TEST(FloorFactor, IsTheGapBetweenBottomAndFloor)
{
  const Ellipsoid upright(CPose3D(1, 2, 0.95, 1, 0, 0), {0.3, 0.2, 0.9});
  for (const double huber : {kQuadratic, 1.5})
  {
    const auto factor = createFloorFactor(0.02, huber, ObjectFreedom::Upright);
    expectRightDerivatives(
        *factor, {
                     objectBlock(upright, ObjectFreedom::Upright), Block{{0.01}, nullptr}
    });
  }
  const auto factor = createFloorFactor(0.02, kQuadratic, ObjectFreedom::Upright);
  const auto r = residualsOf(
      *factor, {
                   objectBlock(upright, ObjectFreedom::Upright), Block{{0.01}, nullptr}
  });
  EXPECT_NEAR(r[0], 0.04 / 0.02, 1e-9);

  const auto leaning = createFloorFactor(0.02, kQuadratic, ObjectFreedom::Free);
  expectRightDerivatives(
      *leaning, {
                    objectBlock(kObject, ObjectFreedom::Free), Block{{0.01}, nullptr}
  });
  double lowest = 1e9;
  for (int i = 0; i <= 600; ++i)
    for (int j = 0; j < 1200; ++j)
    {
      const double theta = M_PI * i / 600, phi = M_PI * j / 600;
      const Eigen::Vector3d unit(
          std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      const Eigen::Vector3d p =
          kObject.center() + kObject.rotation() * kObject.semiAxes().cwiseProduct(unit);
      lowest = std::min(lowest, p.z());
    }
  const auto sampled = residualsOf(
      *leaning, {
                    objectBlock(kObject, ObjectFreedom::Free), Block{{0.01}, nullptr}
  });
  EXPECT_NEAR(sampled[0] * 0.02, lowest - 0.01, 1e-4);
}

TEST(ObjectPriorFactor, IsTheQuadraticItStandsFor)
{
  for (const auto freedom : {ObjectFreedom::Upright, ObjectFreedom::Free})
    for (const int rank : {2, 12})
    {
      const int size = incrementSize(freedom);
      const auto prior = randomPrior(size, freedom, rank);
      const auto factor = createObjectPrior(prior, freedom);
      const Block at = objectBlock(kObject, freedom);
      const Eigen::VectorXd r0 = residualsOf(*factor, {at});
      for (int c = 0; c < size; ++c)
      {
        const Block moved = at.moved(c, 0.2);
        expectRightDerivatives(*factor, {moved});
        const double expected = 0.5 * 0.04 * prior.L(c, c) + 0.2 * prior.g[c];
        const double cost = 0.5 * (residualsOf(*factor, {moved}).squaredNorm() - r0.squaredNorm());
        EXPECT_NEAR(cost, expected, 1e-8 * (1 + std::abs(expected)));
      }
    }
}

TEST(ObjectPriorFactor, CauchysKernelLimitsWhatItSays)
{
  constexpr double kCauchy = 2.0;
  for (const auto freedom : {ObjectFreedom::Upright, ObjectFreedom::Free})
  {
    const auto plain = randomPrior(incrementSize(freedom), freedom, 12);
    auto prior = plain;
    prior.cauchy = kCauchy;
    const auto factor = createObjectPrior(prior, freedom);
    const Block at = objectBlock(kObject, freedom);
    for (const double step : {1e-3, 0.2, 1.0})
    {
      const Block moved = at.moved(1, step);
      expectRightDerivatives(*factor, {moved});
      const double square = residualsOf(*createObjectPrior(plain, freedom), {moved}).squaredNorm();
      EXPECT_NEAR(
          residualsOf(*factor, {moved}).squaredNorm(),
          kCauchy * kCauchy * std::log(1 + square / (kCauchy * kCauchy)), 1e-9 * (1 + square));
    }
  }
}
