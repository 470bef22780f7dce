#include "FloorLevel.h"

#include <gtest/gtest.h>
#include <mrpt/poses/Lie/SO.h>

#include <cmath>

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
constexpr double kDegree = M_PI / 180;
const CPose3D kCamera(0.1, 0, 1.2, 0.3, 0.4, 0);  // T_robot_sensor

CPose3D robotAt(int i)
{
  return {0.1 * i, 0.5, 0.02 * std::sin(i), 0.2 * i, 0.02 * std::sin(2.0 * i), 0.03};
}

/** The horizontal surfaces of a frame of the true pose. */
FrameSurfaces seenFrom(const CPose3D& T_world_robot, SurfaceKind kind)
{
  SurfacePatch patch;
  patch.kind = kind;
  patch.plane = Plane{}.transformed(-(T_world_robot + kCamera));
  FrameSurfaces frame;
  frame.seen.push_back(patch);
  return frame;
}

/** Angle between where two poses have "up" [rad]. */
double tiltBetween(const CPose3D& a, const CPose3D& b)
{
  const Eigen::Matrix3d A = a.getRotationMatrix().asEigen(), B = b.getRotationMatrix().asEigen();
  return std::acos(std::min(1.0, A.row(2).dot(B.row(2))));
}

/** The tilt that is left after some frames of an odometry whose frame leans more and more. */
double tiltAfter(int frames, double share, SurfaceKind kind)
{
  FloorLevel level(share);
  CPose3D drifted;
  for (int i = 0; i < frames; ++i)
  {
    drifted = CPose3D(0, 0, 0, 0.3, 0.2 * kDegree * i, -0.1 * kDegree * i) + robotAt(i);
    level.look(seenFrom(robotAt(i), kind), level.levelled(drifted) + kCamera);
  }
  const CPose3D levelled = level.levelled(drifted);
  EXPECT_EQ(levelled.x(), drifted.x());
  EXPECT_EQ(levelled.y(), drifted.y());
  EXPECT_EQ(levelled.z(), drifted.z());
  return tiltBetween(levelled, robotAt(frames - 1));
}

}  // namespace

TEST(FloorLevel, TheFloorSetsADriftingOdometryUpright)
{
  constexpr int kFrames = 40;
  EXPECT_GT(tiltAfter(kFrames, 0, SurfaceKind::Floor), 8 * kDegree);
  EXPECT_LT(tiltAfter(kFrames, 0.5, SurfaceKind::Floor), 0.5 * kDegree);
  EXPECT_LT(tiltAfter(kFrames, 1, SurfaceKind::Floor), 1e-6);
}

TEST(FloorLevel, OtherSurfacesSayNothing)
{
  EXPECT_GT(tiltAfter(40, 1, SurfaceKind::Horizontal), 8 * kDegree);
}

TEST(FloorLevel, WhatIsUprightStaysAsItIs)
{
  FloorLevel level(0.5);
  level.look(seenFrom(robotAt(3), SurfaceKind::Floor), robotAt(3) + kCamera);
  const CPose3D levelled = level.levelled(robotAt(4)), off = levelled - robotAt(4);
  EXPECT_LT(off.norm(), 1e-9);
  EXPECT_LT(mrpt::poses::Lie::SO<3>::log(off.getRotationMatrix()).norm(), 1e-9);
}
