#include "cuboid/HeadingEstimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/geometry/RotationDistance.h"

namespace quadmap
{
namespace
{
constexpr double kDegree = M_PI / 180;
using Rng = std::mt19937;

double gauss(Rng& rng, double sigma)
{
  return sigma > 0 ? std::normal_distribution<double>(0.0, sigma)(rng) : 0.0;
}

/** An upright face as a depth camera samples it: from `corner` along `heading + 90 degrees`, with a
 * normal along `heading`. Three neighbouring points share their noise. */
struct Face
{
  Eigen::Vector2d corner;
  double heading, width, height;
  double noise;        // across the face [m]
  double normalNoise;  // of each normal's heading [rad]
};

void addFace(UprightCloud& cloud, const Face& face, Rng& rng)
{
  constexpr double kStep = 0.01;  // [m]
  const Eigen::Vector2d n(std::cos(face.heading), std::sin(face.heading)), t(-n.y(), n.x());
  for (double z = 0; z < face.height; z += kStep)
  {
    double shared = 0;
    int i = 0;
    for (double s = 0; s < face.width; s += kStep, ++i)
    {
      if (i % 3 == 0) shared = gauss(rng, face.noise);
      const Eigen::Vector2d p = face.corner + s * t + shared * n;
      cloud.points.emplace_back(p.x(), p.y(), z);
      const double heading = face.heading + gauss(rng, face.normalNoise);
      cloud.normals.emplace_back(Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0));
    }
  }
}

UprightCloud emptyCloud(double range)
{
  UprightCloud out;
  out.medianRange = range;
  out.cellsPerNormal = 9;  // normals of 3 by 3 points
  return out;
}

constexpr double kAskewYaw = 0.6;  // [rad]

/** A face that is cut askew, the higher the farther on, as by the box of a camera that looks at it
 * from the side. \param lean Of the face, \param normals ... and of its normals [rad]. */
UprightCloud askewFace(double lean, double normals)
{
  constexpr double kStep = 0.01, kHalf = 0.2, kAskew = 0.5;
  const Eigen::Vector3d along(-std::sin(kAskewYaw), std::cos(kAskewYaw), 0);
  const Eigen::Vector3d ahead(std::cos(kAskewYaw), std::sin(kAskewYaw), 0);
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d up = std::cos(lean) * z - std::sin(lean) * ahead;
  const Eigen::Vector3d normal = std::cos(normals) * ahead + std::sin(normals) * z;
  UprightCloud cloud = emptyCloud(2.0);
  Rng rng(14);
  for (double s = -kHalf; s < kHalf; s += kStep)
    for (double h = -kHalf; h < kHalf; h += kStep)
    {
      cloud.points.emplace_back((s + kAskew * h) * along + h * up + gauss(rng, 0.002) * ahead);
      const Eigen::Vector3d noise(gauss(rng, 0.02), gauss(rng, 0.02), gauss(rng, 0.02));
      cloud.normals.emplace_back((normal + noise).normalized());
    }
  return cloud;
}

/** Mean and variance of (yaw - truth) / sigma. */
struct Normalised
{
  double sum = 0, squares = 0;
  int n = 0, undefined = 0;

  void add(const HeadingEstimate& estimate, double truth)
  {
    if (!estimate.defined)
    {
      ++undefined;
      return;
    }
    const double error = nearestEquivalentYaw(estimate.yaw, truth) - truth;
    sum += error / estimate.sigma;
    squares += error * error / (estimate.sigma * estimate.sigma);
    ++n;
  }
  double mean() const { return sum / n; }
  double variance() const { return squares / n - mean() * mean(); }
};

constexpr int kRuns = 400;  // the variance of the variance is then 2 / 400: 0.07

void expectHonest(const Normalised& result)
{
  EXPECT_EQ(result.undefined, 0);
  EXPECT_LT(std::abs(result.mean()), 0.3);
  EXPECT_GT(result.variance(), 0.7);
  EXPECT_LT(result.variance(), 1.4);
}

TEST(HeadingEstimate, ClaimsTheSigmaItHasOnTwoFaces)
{
  Rng rng(11);
  Normalised result;
  for (int run = 0; run < kRuns; ++run)
  {
    const double yaw = std::uniform_real_distribution<double>(0, M_PI / 2)(rng);
    UprightCloud cloud = emptyCloud(3.0);
    addFace(
        cloud,
        {
            {3, 0},
            yaw, 0.4, 0.3, 0.02, 0.1
    },
        rng);
    addFace(
        cloud,
        {
            {3, 0},
            yaw + M_PI / 2, 0.3, 0.3, 0.02, 0.1
    },
        rng);
    result.add(estimateHeading(cloud, {}), yaw);
  }
  expectHonest(result);
}

TEST(HeadingEstimate, ClaimsTheSigmaItHasOnOneNarrowFace)
{
  Rng rng(12);
  Normalised result;
  for (int run = 0; run < kRuns; ++run)
  {
    const double yaw = std::uniform_real_distribution<double>(0, M_PI / 2)(rng);
    UprightCloud cloud = emptyCloud(2.0);
    addFace(
        cloud,
        {
            {2, 0},
            yaw, 0.15, 0.2, 0.008, 0.1
    },
        rng);
    result.add(estimateHeading(cloud, {}), yaw);
  }
  expectHonest(result);
}

TEST(HeadingEstimate, OfWhatLeansIsThatOfItsFace)
{
  for (const double lean : {-18.0, 12.0, 18.0})
  {
    const HeadingEstimate heading = estimateHeading(askewFace(lean * kDegree, lean * kDegree), {});
    ASSERT_TRUE(heading.defined) << lean;
    const double error = nearestEquivalentYaw(heading.yaw, kAskewYaw) - kAskewYaw;
    EXPECT_NEAR(error, 0, 0.5 * kDegree) << lean;
    EXPECT_LT(std::abs(error), 3 * heading.sigma) << lean;
  }
}

TEST(HeadingEstimate, NormalsThatLeanByLittleDoNotTurnWhatIsUpright)
{
  const HeadingEstimate heading = estimateHeading(askewFace(0, 4 * kDegree), {});
  ASSERT_TRUE(heading.defined);
  EXPECT_NEAR(nearestEquivalentYaw(heading.yaw, kAskewYaw), kAskewYaw, 0.5 * kDegree);
}

TEST(HeadingEstimate, TrustsNeitherOfTwoFacesThatContradictEachOther)
{
  Rng rng(13);
  UprightCloud cloud = emptyCloud(2.0);
  addFace(
      cloud,
      {
          {2, 0},
          0.0, 0.4, 0.3, 0.004, 0.05
  },
      rng);
  addFace(
      cloud,
      {
          {2, 0},
          M_PI / 2 + 6 * kDegree, 0.4, 0.3, 0.004, 0.05
  },
      rng);
  const auto estimate = estimateHeading(cloud, {});
  ASSERT_TRUE(estimate.defined);
  EXPECT_GT(estimate.sigma, 1.5 * kDegree) << "six degrees between two faces";
}

TEST(HeadingEstimate, FindsNoHeadingOfARoundThing)
{
  Rng rng(14);
  UprightCloud cloud = emptyCloud(1.5);
  for (double heading = 0; heading < M_PI; heading += 0.01)
    for (double z = 0; z < 0.2; z += 0.01)
    {
      const Eigen::Vector3d n(std::cos(heading), std::sin(heading), 0);
      cloud.points.emplace_back(Eigen::Vector3d(1.5, 0, z) + 0.1 * n);
      cloud.normals.emplace_back(n);
    }
  EXPECT_FALSE(estimateHeading(cloud, {}).defined);
}

TEST(HeadingEstimate, TakesTheLineOfAFlatThingWithoutNormals)
{
  Rng rng(15);
  for (const double yaw : {-0.6, 0.1, 0.9})
  {
    UprightCloud cloud = emptyCloud(2.0);
    addFace(
        cloud,
        {
            {2, 0},
            yaw, 1.0, 0.04, 0.006, 0.0
    },
        rng);  // the rim of a screen, no more
    cloud.normals.assign(cloud.points.size(), std::nullopt);
    const auto estimate = estimateHeading(cloud, {});
    ASSERT_TRUE(estimate.defined);
    EXPECT_LT(yawDistance(estimate.yaw, yaw), 3 * estimate.sigma);
    EXPECT_LT(estimate.sigma, 1.0 * kDegree);
  }
}

TEST(HeadingEstimate, TakesTheSmallestOfAllRectanglesWithoutNormals)
{
  Rng rng(6);
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  for (int i = 0; i < 40; ++i)
  {
    UprightCloud cloud = emptyCloud(2.0);
    const double width = 0.3 + 0.5 * (share(rng) + 0.5);
    const Eigen::Rotation2Dd turned(M_PI * share(rng));
    for (int k = 0; k < 390; ++k)
    {
      const Eigen::Vector2d p = turned * Eigen::Vector2d(width * share(rng), 0.3 * share(rng));
      cloud.points.emplace_back(2 + p.x(), p.y(), 0.0);
    }
    cloud.normals.resize(cloud.points.size());
    double smallest = 1e9, heading = 0;
    for (int degree = 0; degree < 90; degree += 2)
    {
      std::vector<double> x, y;
      const Eigen::Rotation2Dd back(-degree * kDegree);
      for (const auto& p : cloud.points)
      {
        const Eigen::Vector2d q = back * p.head<2>();
        x.push_back(q.x());
        y.push_back(q.y());
      }
      const QuantileRange along = quantileRange(x, 0.02), across = quantileRange(y, 0.02);
      if (along.width() * across.width() >= smallest) continue;
      smallest = along.width() * across.width();
      heading = degree * kDegree + (along.width() >= across.width() ? 0.0 : M_PI / 2);
    }
    const HeadingEstimate yaw = estimateHeading(cloud, PerceptionOptions());
    ASSERT_FALSE(yaw.defined);
    EXPECT_NEAR(yaw.yaw, heading, 1e-9) << i;
  }
}

TEST(HeadingEstimate, NeedsEnoughIndependentNormals)
{
  UprightCloud cloud = emptyCloud(2.0);
  cloud.cellsPerNormal = 60;  // all normals below share the noise of one or two
  for (int i = 0; i < 80; ++i)
  {
    cloud.points.emplace_back(2.0, 0.001 * i, 0.05);
    cloud.normals.emplace_back(Eigen::Vector3d(-1, 0, 0));
  }
  EXPECT_FALSE(estimateHeading(cloud, {}).defined);
}

}  // namespace
}  // namespace quadmap
