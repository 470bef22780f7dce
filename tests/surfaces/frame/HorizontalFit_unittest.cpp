#include "frame/HorizontalFit.h"

#include <gtest/gtest.h>

#include <random>

using namespace quadmap;

namespace
{
const Eigen::Vector3d kUp(0, -0.8, -0.6);  // of a camera that looks down by 37 degrees

/** Points with depth noise on a rectangle of a horizontal plane, in the optical frame. */
std::vector<Eigen::Vector3d> patch(
    const Eigen::Vector3d& middle,
    const Eigen::Vector3d& normal,
    double width,
    double length,
    int count,
    std::mt19937& random)
{
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitX().cross(normal).normalized();
  const Eigen::Vector3d across = normal.cross(ahead);
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  const SurfaceOptions options;
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < count; ++i)
  {
    const Eigen::Vector3d p =
        middle + width * share(random) * across + length * share(random) * ahead;
    std::normal_distribution<double> noise(0, options.depthSigma(p.z()));
    out.push_back(p * (1 + noise(random) / p.z()));
  }
  return out;
}

}  // namespace

TEST(HorizontalFit, TellsATableFromWhatLiesOnIt)
{
  // A plane through a table and the keyboard on it is on neither: 28 mm apart, seen from 1.3 m.
  std::mt19937 random(1);
  const Eigen::Vector3d table(0, 0.1, 1.3);
  auto points = patch(table, kUp, 0.8, 0.5, 250, random);
  const auto keyboard =
      patch(table + 0.028 * kUp + Eigen::Vector3d(0.2, 0, 0), kUp, 0.4, 0.15, 150, random);
  points.insert(points.end(), keyboard.begin(), keyboard.end());
  const Eigen::Vector3d tilted = (kUp + Eigen::Vector3d(0.08, 0, 0)).normalized();
  const auto fit = fitMainHeight(points, tilted, kUp, SurfaceOptions());
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->plane.signedDistance(table), 0.0, 0.001);
  EXPECT_NEAR(fit->plane.signedDistance(table + Eigen::Vector3d(0.4, 0, 0)), 0.0, 0.003);
  EXPECT_NEAR(static_cast<double>(fit->samples.size()), 250.0, 15.0);
}

TEST(HorizontalFit, FollowsALargeSurfaceThatSaysUpIsElsewhere)
{
  // Poses are good to a degree or two; a floor of metres knows better.
  std::mt19937 random(2);
  const Eigen::Vector3d truth = (kUp + Eigen::Vector3d(0.035, 0, 0)).normalized();
  const Eigen::Vector3d middle(0, 0.6, 1.6);
  const auto points = patch(middle, truth, 2.0, 1.5, 600, random);
  // A surface known from other frames has no normal of its own in this one.
  for (const Eigen::Vector3d& start : {truth, kUp})
  {
    const auto fit = fitMainHeight(points, start, kUp, SurfaceOptions());
    ASSERT_TRUE(fit);
    EXPECT_LT(std::acos(fit->plane.n.dot(truth)), 0.003);
    EXPECT_GT(fit->samples.size(), 560U);
  }
}

TEST(HorizontalFit, DoesNotBelieveTheSlopeOfASmallPatch)
{
  std::mt19937 random(3);
  double worst = 0;
  for (int i = 0; i < 20; ++i)
  {
    const Eigen::Vector3d middle(0.5, 0.8, 3.5);
    const auto fit =
        fitMainHeight(patch(middle, kUp, 0.2, 0.2, 60, random), kUp, kUp, SurfaceOptions());
    ASSERT_TRUE(fit);
    worst = std::max(worst, std::acos(std::min(1.0, fit->plane.n.dot(kUp))));
    EXPECT_NEAR(fit->plane.signedDistance(middle), 0.0, 0.008);
  }
  EXPECT_LT(worst, 0.012);
}

TEST(HorizontalFit, NeedsPoints)
{
  EXPECT_FALSE(fitMainHeight({}, kUp, kUp, SurfaceOptions()));
  EXPECT_FALSE(fitMainHeight(
      {
          {  0, 0, 1},
          {0.1, 0, 1}
  },
      kUp, kUp, SurfaceOptions()));
}
