#include "quadmap/geometry/RotationDistance.h"

#include <gtest/gtest.h>

#include <vector>

#include "RandomGeometry.h"

using namespace quadmap;
using namespace quadmap::test;

namespace
{
/** The 24 rotations of a cube, generated from two quarter turns instead of from permutations. */
std::vector<Eigen::Matrix3d> cubeRotations()
{
  const Eigen::Matrix3d x =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix().array().round();
  const Eigen::Matrix3d z =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix().array().round();
  std::vector<Eigen::Matrix3d> found{Eigen::Matrix3d::Identity()};
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const Eigen::Matrix3d& generator : {x, z})
    {
      const Eigen::Matrix3d next = found[i] * generator;
      bool isNew = true;
      for (const auto& old : found) isNew = isNew && old != next;
      if (isNew) found.push_back(next);
    }
  return found;
}
}  // namespace

TEST(SymmetricRotationDistance, IsTheSmallestOverAllCubeRotations)
{
  const auto cube = cubeRotations();
  ASSERT_EQ(cube.size(), 24u);
  RandomGeometry random(21);
  for (int trial = 0; trial < 200; ++trial)
  {
    const Eigen::Matrix3d A = random.rotation(), B = random.rotation();
    double smallest = 10;
    for (const auto& P : cube)
      smallest = std::min(smallest, std::abs(Eigen::AngleAxisd(A.transpose() * (B * P)).angle()));
    const SymmetricRotation found = symmetricRotationDistance(A, B);
    EXPECT_NEAR(found.angle, smallest, 1e-7);
    EXPECT_NEAR(found.relabeling.determinant(), 1, 1e-12);
    EXPECT_NEAR(
        std::abs(Eigen::AngleAxisd(A.transpose() * B * found.relabeling).angle()), smallest, 1e-7);
  }
}

TEST(SymmetricRotationDistance, IsZeroForEveryRelabelingOfTheSameBox)
{
  RandomGeometry random(22);
  const Eigen::Matrix3d A = random.rotation();
  for (const auto& P : cubeRotations())
  {
    const SymmetricRotation found = symmetricRotationDistance(A, A * P);
    EXPECT_NEAR(found.angle, 0, 1e-14);
    EXPECT_LT((P * found.relabeling - Eigen::Matrix3d::Identity()).norm(), 1e-12)
        << "the relabeling undoes the swap of axes";
  }
}

TEST(SymmetricRotationDistance, ResolvesSmallAngles)
{
  const Eigen::Matrix3d B = Eigen::AngleAxisd(1e-9, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(symmetricRotationDistance(Eigen::Matrix3d::Identity(), B).angle, 1e-9, 1e-15);
}

TEST(YawDistance, FoldsByThePeriod)
{
  EXPECT_NEAR(yawDistance(0.1, 0.3), 0.2, 1e-15);
  EXPECT_NEAR(yawDistance(0.05, M_PI / 2 - 0.05), 0.1, 1e-12);
  EXPECT_NEAR(yawDistance(3.1, -3.1), 2 * M_PI - 6.2, 1e-12);
  EXPECT_NEAR(yawDistance(0, M_PI / 4), M_PI / 4, 1e-12) << "the largest possible";
  EXPECT_NEAR(yawDistance(0.2, 0.1 + M_PI / 2, M_PI), M_PI / 2 - 0.1, 1e-12);
  EXPECT_NEAR(yawDistance(0.2, 20 * M_PI + 0.1, 2 * M_PI), 0.1, 1e-12);
}

TEST(NearestEquivalentYaw, StaysEquivalentAndNear)
{
  RandomGeometry random(23);
  for (double period : {M_PI / 2, M_PI, 2 * M_PI})
    for (int i = 0; i < 50; ++i)
    {
      const double yaw = random.uniform(-10, 10), reference = random.uniform(-10, 10);
      const double nearest = nearestEquivalentYaw(yaw, reference, period);
      EXPECT_LE(std::abs(nearest - reference), period / 2 + 1e-12);
      const double turns = (nearest - yaw) / period;
      EXPECT_NEAR(turns, std::round(turns), 1e-12);
    }
}

TEST(QuarterTurns, LeadToTheNearestEquivalentYaw)
{
  RandomGeometry random(24);
  for (int i = 0; i < 50; ++i)
  {
    const double yaw = random.uniform(-10, 10), reference = random.uniform(-10, 10);
    EXPECT_NEAR(
        yaw + quarterTurnsTo(yaw, reference) * M_PI / 2, nearestEquivalentYaw(yaw, reference),
        1e-12);
  }
}
