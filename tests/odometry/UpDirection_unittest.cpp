#include "quadmap/odometry/UpDirection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../surfaces/SyntheticFrame.h"

using namespace quadmap;
using Eigen::Vector3d;

namespace
{
/** A table and two walls; the robot's frame is that of the camera. */
SyntheticFrame room()
{
  SyntheticFrame frame(1.3, 0.4);
  frame.noise = 0.0015;
  frame.add(1.9, 0.0, 0.0, 0.3, {0.9, 1.5, 0.74});
  frame.add(3.4, 0.0, 0.0, 0.1, {0.1, 8.0, 2.5});
  frame.add(1.5, 1.8, 0.0, 0.1, {6.0, 0.1, 2.5});
  return frame;
}

Vector3d tilted(const Vector3d& up, double angle)
{
  return Eigen::AngleAxisd(angle, up.cross(Vector3d::UnitX()).normalized()) * up;
}

double angleBetween(const Vector3d& a, const Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}
}  // namespace

TEST(UpDirection, WhatIsLevelAndUprightCorrectsTheFloor)
{
  const SyntheticFrame frame = room();
  const Vector3d up = levelled({}, frame.scan(), tilted(frame.up_sensor(), 0.05));
  EXPECT_LT(angleBetween(up, frame.up_sensor()), 0.01);
}

TEST(UpDirection, AFloorThatTheRestContradictsStays)
{
  const SyntheticFrame frame = room();
  const Vector3d slope = tilted(frame.up_sensor(), 0.3);
  EXPECT_EQ(levelled({}, frame.scan(), slope), slope);
}
