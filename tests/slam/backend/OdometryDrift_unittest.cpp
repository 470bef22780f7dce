#include "backend/OdometryDrift.h"

#include <gtest/gtest.h>

#include <random>

#include "BentDrive.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
/** Where a thing at p that keyframe `again` sees is, when it is followed from keyframe `before`
 * along steps with these errors. */
Eigen::Vector3d seenAlong(
    const std::vector<Keyframe>& keyframes,
    const std::vector<CPose3D>& steps,
    const OdometryDrift::Moved& thing)
{
  CPose3D pose = keyframes[thing.before].T_map_robot;
  for (std::size_t k = thing.before + 1; k <= thing.again; ++k) pose = pose + steps[k];
  const auto p = (pose + (-keyframes[thing.again].T_map_robot))
                     .composePoint({thing.place.x(), thing.place.y(), thing.place.z()});
  return {p.x, p.y, p.z};
}

}  // namespace

// The oracle draws errors of the steps and follows them.
TEST(OdometryDrift, IsThatOfDrawnSteps)
{
  const auto keyframes = bentDrive();
  const OdometryDrift drift(keyframes, {2, 3});
  const OdometryDrift::Moved a{
      {3, 1, 0.5},
      1, 6
  },
      b{{-1, 2, 1}, 3, 8};
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 20000;
  Eigen::Matrix3d ab = Eigen::Matrix3d::Zero(), aa = ab;
  for (int n = 0; n < kDraws; ++n)
  {
    std::vector<CPose3D> steps(1);
    for (std::size_t k = 1; k < keyframes.size(); ++k)
    {
      const CPose3D& mean = keyframes[k].odometryStep->mean;
      std::array<double, 6> e{};
      for (int i = 0; i < 6; ++i) e[i] = 1e-3 * (i + 1) * (i < 3 ? 2 : 3) * normal(random);
      steps.emplace_back(
          mean.x() + e[0], mean.y() + e[1], mean.z() + e[2], mean.yaw() + e[3], mean.pitch() + e[4],
          mean.roll() + e[5]);
    }
    const Eigen::Vector3d da = seenAlong(keyframes, steps, a) - a.place,
                          db = seenAlong(keyframes, steps, b) - b.place;
    aa += da * da.transpose() / kDraws;
    ab += da * db.transpose() / kDraws;
  }
  // Drawn variances err by sqrt(2 / 20000) = 1 %.
  const double scale = aa.trace();
  EXPECT_LT((drift.covariance(a, a) - aa).norm(), 0.03 * scale);
  EXPECT_LT((drift.covariance(a, b) - ab).norm(), 0.03 * scale);
}

TEST(OdometryDrift, OfThingsWithoutCommonStepsIsIndependent)
{
  const OdometryDrift drift(bentDrive(), {});
  EXPECT_EQ(
      drift
          .covariance(
              {
                  {1, 0, 0},
                  0, 3
  },
              {{1, 0, 0}, 3, 6})
          .norm(),
      0);
}
