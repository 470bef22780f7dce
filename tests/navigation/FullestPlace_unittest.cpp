#include "FullestPlace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace quadmap;

namespace
{
constexpr double kPerDegree = M_PI / 180;

/** Adds poses around a yaw, at places of less than a cell. */
void addPoses(
    std::vector<LevelPose>& poses, int count, const Eigen::Vector3d& at, double yaw, double spread)
{
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> off(-1, 1);
  for (int i = 0; i < count; ++i)
  {
    const double turned = yaw + spread * off(rng);
    poses.push_back(
        {at + 0.1 * Eigen::Vector3d(off(rng), off(rng), off(rng)),
         std::atan2(std::sin(turned), std::cos(turned))});
  }
}

}  // namespace

TEST(FullestPlace, PosesOnBothSidesOfHalfATurnAreTogether)
{
  for (const double yaw : {180.0, -100.0, 0.0, 60.0})
  {
    std::vector<LevelPose> poses;
    addPoses(poses, 600, {1, 2, 0}, yaw * kPerDegree, 8 * kPerDegree);
    addPoses(poses, 400, {-3, 0, 0}, 20 * kPerDegree, 8 * kPerDegree);  // in one cell
    const LevelPose found = fullestPlace(poses, std::vector<double>(poses.size(), 1.0), 0.5, 0.35);
    EXPECT_NEAR(found.position.x(), 1, 0.05) << yaw;
    EXPECT_NEAR(std::remainder(found.yaw - yaw * kPerDegree, 2 * M_PI), 0, 2 * kPerDegree) << yaw;
  }
}

TEST(FullestPlace, WeightsDecideAndNotNumbers)
{
  std::vector<LevelPose> poses;
  addPoses(poses, 10, {1, 2, 0.5}, 1, 0.01);
  addPoses(poses, 90, {-3, 0, 0}, 1, 0.01);
  std::vector<double> weights(poses.size(), 0.1);
  std::fill(weights.begin(), weights.begin() + 10, 1.0);
  const LevelPose found = fullestPlace(poses, weights, 0.5, 0.35);
  EXPECT_LT((found.position - Eigen::Vector3d(1, 2, 0.5)).norm(), 0.15);
}

TEST(FullestPlace, CellsMayBeWiderThanATurn)
{
  const LevelPose found = fullestPlace(
      {
          {{0, 0, 0},  3},
          {{0, 0, 0}, -3}
  },
      {1, 1}, 0.5, 7);
  EXPECT_NEAR(std::abs(found.yaw), M_PI, 1e-9);
}
