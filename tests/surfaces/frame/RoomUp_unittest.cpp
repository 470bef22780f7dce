#include "quadmap/surfaces/RoomUp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "../SyntheticFrame.h"
#include "quadmap/geometry/PinholeCamera.h"

namespace quadmap
{
namespace
{
using Eigen::Vector3d;

const Vector3d kImageUp(0, -1, 0);  // optical frame

/** Up in the optical frame of a camera that looks down and is turned about its axis. */
Vector3d upOf(double pitchDown, double roll)
{
  const mrpt::poses::CPose3D T(0, 0, 0, 0, pitchDown, roll);
  return (T + T_sensor_optical()).getRotationMatrix().asEigen().row(2);
}

ScenePlane planeOf(const Vector3d& normal, double share)
{
  ScenePlane plane;
  plane.plane.n = normal.normalized();
  plane.share = share;
  return plane;
}

double angleBetween(const Vector3d& a, const Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/** A direction at right angles with up, a wall's. */
Vector3d across(const Vector3d& up, double turn)
{
  const Vector3d u = up.cross(Vector3d::UnitZ()).normalized();
  return Eigen::AngleAxisd(turn, up) * u;
}
}  // namespace

TEST(RoomUp, OfATableAndOfWalls)
{
  const std::vector<std::pair<double, double>> cameras = {
      {   0,    0},
      { 0.5,  0.2},
      {-0.4, -0.6},
      { 0.7,  0.0}
  };
  for (const auto& [pitch, roll] : cameras)
  {
    const Vector3d up = upOf(pitch, roll);
    const std::vector<ScenePlane> all = {
        planeOf(up, 0.3), planeOf(across(up, 0.4), 0.2), planeOf(across(up, 2.1), 0.1)};
    for (const std::string shown : {"a table", "a table, a wall", "two walls", "all"})
    {
      std::vector<ScenePlane> planes = all;
      if (shown == "a table") planes.resize(1);
      if (shown == "a table, a wall") planes.resize(2);
      if (shown == "two walls") planes.erase(planes.begin());
      const auto found = upOfRoom(planes, kImageUp);
      ASSERT_TRUE(found) << pitch << " " << shown;
      EXPECT_LT(angleBetween(*found, up), 1e-6) << pitch << " " << shown;
    }
  }
}

TEST(RoomUp, WhatIsNeitherLevelNorUprightIsOutvoted)
{
  const Vector3d up = upOf(0.4, 0.1);
  const Vector3d slope = Eigen::AngleAxisd(0.5, across(up, 1.0)) * up;
  const auto found =
      upOfRoom({planeOf(slope, 0.25), planeOf(up, 0.15), planeOf(across(up, 0.0), 0.15)}, kImageUp);
  ASSERT_TRUE(found);
  EXPECT_LT(angleBetween(*found, up), 1e-6);
}

TEST(RoomUp, EachPlaneCountsByWhatItCoversOfTheImage)
{
  constexpr double kError = 0.03;  // [rad], of the smaller one
  const Vector3d up = upOf(0.4, 0.0);
  const Vector3d wrong = Eigen::AngleAxisd(kError, across(up, 0.0)) * up;
  const auto found = upOfRoom({planeOf(up, 0.4), planeOf(wrong, 0.1)}, kImageUp);
  ASSERT_TRUE(found);
  EXPECT_NEAR(angleBetween(*found, up), 0.2 * kError, 1e-3);
}

TEST(RoomUp, AWallThatFillsTheImageTellsNothing)
{
  const Vector3d up = upOf(0.1, 0.0);
  EXPECT_FALSE(upOfRoom({planeOf(across(up, 0.3), 0.9)}, kImageUp));
  EXPECT_FALSE(upOfRoom({planeOf(up, 0.1)}, kImageUp)) << "too small a part of the image";
  EXPECT_FALSE(upOfRoom({}, kImageUp));
}

TEST(RoomUp, OfAFrameWithoutAFloor)
{
  SyntheticFrame frame(1.3, 0.4);
  frame.hasFloor = false;
  frame.noise = 0.0015;
  frame.add(1.9, 0.0, 0.70, 0.3, {0.9, 1.5, 0.04});
  frame.add(3.4, 0.0, 0.0, 0.1, {0.1, 8.0, 2.5});
  const SurfaceOptions options;
  const DepthCloud cloud(frame.scan(), options);
  const auto found = upOfRoom(segmentPlanes(cloud, options).planes, kImageUp);
  ASSERT_TRUE(found);
  EXPECT_LT(angleBetween(*found, upOf(0.4, 0.0)), 0.02);
}

}  // namespace quadmap
