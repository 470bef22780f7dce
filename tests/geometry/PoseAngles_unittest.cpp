#include "quadmap/geometry/PoseAngles.h"

#include <gtest/gtest.h>

#include "quadmap/geometry/RotationVector.h"

using namespace quadmap;

namespace
{
const mrpt::poses::CPose3D kPose(1, 2, 3, 0.7, -0.4, 0.2);

Eigen::Matrix3d rotation(const mrpt::poses::CPose3D& pose)
{
  return pose.getRotationMatrix().asEigen();
}

/** The pose with one of (yaw, pitch, roll) changed. */
mrpt::poses::CPose3D changed(int angle, double by)
{
  Eigen::Vector3d angles(kPose.yaw(), kPose.pitch(), kPose.roll());
  angles[angle] += by;
  return {kPose.x(), kPose.y(), kPose.z(), angles[0], angles[1], angles[2]};
}
}  // namespace

TEST(PoseAngles, LocalTurnsAreThoseOfSmallChangesOfTheAngles)
{
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Matrix3d turned = rotation(kPose).transpose() * rotation(changed(i, kStep));
    const Eigen::Vector3d turn = rotationVectorOf(Eigen::Quaterniond(turned)) / kStep;
    EXPECT_LT((localTurnsPerAngle(kPose).col(i) - turn).norm(), 1e-5) << i;
  }
}

TEST(PoseAngles, AnglesPerTurnUndoThem)
{
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Matrix3d turned = rotation(changed(i, kStep)) * rotation(kPose).transpose();
    const Eigen::Vector3d turn = rotationVectorOf(Eigen::Quaterniond(turned)) / kStep;
    const Eigen::Vector3d angles = anglesPerTurn(kPose, 0) * turn;
    EXPECT_LT((angles - Eigen::Vector3d::Unit(i)).norm(), 1e-5) << i;
  }
}

TEST(PoseAngles, StayFiniteWhenLookingStraightDown)
{
  const mrpt::poses::CPose3D down(0, 0, 0, 0.3, M_PI / 2, 0);
  EXPECT_TRUE(anglesPerTurn(down, 1e-3).allFinite());
}
