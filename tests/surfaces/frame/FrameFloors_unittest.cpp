#include <gtest/gtest.h>

#include "../SyntheticFrame.h"
#include "quadmap/surfaces/ScenePlanes.h"

namespace quadmap
{
namespace
{
SurfacePatch floorAt(double z)
{
  return {
      SurfaceKind::Floor, {Eigen::Vector3d::UnitZ(), -z},
       {    },
       false
  };
}

/** What other frames saw of a horizontal surface. */
SurfacePatch knownTop(double x, double y, double z, double depth, double width)
{
  SurfacePatch out = {
      SurfaceKind::Horizontal, {Eigen::Vector3d::UnitZ(), -z},
       {    },
       false
  };
  for (double dx = -depth / 2; dx < depth / 2; dx += 0.05)
    for (double dy = -width / 2; dy < width / 2; dy += 0.05)
      out.samples.emplace_back(float(x + dx), float(y + dy), float(z));
  return out;
}

ScenePlanes planesOf(const SyntheticFrame& frame, const std::vector<SurfacePatch>& known_world)
{
  const SurfaceOptions options;
  const DepthCloud cloud(frame.scan(), options);
  const mrpt::poses::CPose3D T_world_optical = frame.T_world_sensor + T_sensor_optical();
  std::vector<SurfacePatch> known;
  for (const auto& patch : known_world) known.push_back(transformed(patch, -T_world_optical));
  const Eigen::Vector3d up = T_world_optical.getRotationMatrix().asEigen().row(2);
  return classifyPlanes(cloud, segmentPlanes(cloud, options), up, known, options);
}

/** The horizontal plane at a height in the world; null when there is none. */
const ScenePlane* planeAt(const SyntheticFrame& frame, const ScenePlanes& planes, double z)
{
  const mrpt::poses::CPose3D T_world_optical = frame.T_world_sensor + T_sensor_optical();
  for (const int i : planes.horizontal)
  {
    const Plane plane = planes.plane(i).plane.transformed(T_world_optical);
    if (std::abs(-plane.d / plane.n.z() - z) < 0.03) return &planes.plane(i);
  }
  return nullptr;
}

/** A slab with its upper side at a height, closed below or on four legs. */
SyntheticFrame frameWithSlab(double height, bool isClosed)
{
  SyntheticFrame frame(1.5, 0.4);
  constexpr double kTop = 0.04, kLeg = 0.06;
  frame.add(2.6, 0, isClosed ? 0 : height - kTop, 0, {1.2, 1.6, isClosed ? height : kTop});
  for (const double dx : {-0.55, 0.55})
    for (const double dy : {-0.75, 0.75})
      if (!isClosed) frame.add(2.6 + dx, dy, 0, 0, {kLeg, kLeg, height - kTop});
  return frame;
}

}  // namespace

TEST(FrameFloors, APlatformIsAFloorAndATableIsFurniture)
{
  for (const bool isClosed : {true, false})
    for (const double height : {0.25, 0.7})
    {
      const SyntheticFrame frame = frameWithSlab(height, isClosed);
      const auto planes = planesOf(frame, {floorAt(0), knownTop(2.6, 0, height, 1.2, 1.6)});
      const ScenePlane* top = planeAt(frame, planes, height);
      ASSERT_TRUE(top && planes.floor);
      if (!isClosed && height < 0.5) continue;  // one cannot look under it from here
      EXPECT_EQ(top->isFloor, isClosed) << height;
      EXPECT_EQ(top->isFurniture, !isClosed) << height;
      EXPECT_FALSE(planes.contradictsFloor);
    }
}

TEST(FrameFloors, WhatIsKnownAsFurnitureOrIsSmallIsNoFloor)
{
  const SyntheticFrame frame = frameWithSlab(0.25, true);
  SurfacePatch furniture = knownTop(2.6, 0, 0.25, 1.2, 1.6);
  furniture.isFurniture = true;
  for (const auto& patch : {furniture, knownTop(2.6, 0, 0.25, 0.9, 0.9)})
  {
    const auto planes = planesOf(frame, {floorAt(0), patch});
    ASSERT_TRUE(planeAt(frame, planes, 0.25));
    EXPECT_FALSE(planeAt(frame, planes, 0.25)->isFloor);
  }
}

TEST(FrameFloors, TheFloorOfOneStoreyIsNoneWithoutAFloor)
{
  SyntheticFrame frame = frameWithSlab(0.7, true);
  frame.hasFloor = false;
  const auto planes = planesOf(frame, {floorAt(0)});
  ASSERT_TRUE(planes.floor && planeAt(frame, planes, 0.7));
  EXPECT_NEAR(planes.plane(*planes.floor).plane.d, 1.5, 0.01)
      << "that of other frames, 1.5 m below";
  EXPECT_FALSE(planeAt(frame, planes, 0.7)->isFloor);
}

TEST(FrameFloors, AFloorWithThingsBelowItIsContradicted)
{
  const SyntheticFrame empty(1.5, 0.4);
  const auto planes = planesOf(empty, {floorAt(0.6)});
  EXPECT_TRUE(planes.contradictsFloor);
  ASSERT_TRUE(planes.floor);
  EXPECT_NEAR(planes.plane(*planes.floor).plane.d, 1.5, 0.02) << "what the frame shows";
  EXPECT_FALSE(planesOf(empty, {floorAt(0)}).contradictsFloor);
  EXPECT_FALSE(planesOf(empty, {floorAt(0.08)}).contradictsFloor) << "poses err";
}

TEST(FrameFloors, AFloorThatShowsBesideALowerOneStaysAFloor)
{
  const SyntheticFrame frame = frameWithSlab(0.25, true);
  const auto planes = planesOf(frame, {floorAt(0.25)});  // the camera came over the platform
  EXPECT_FALSE(planes.contradictsFloor);
  ASSERT_TRUE(planes.floor && planeAt(frame, planes, 0.25));
  EXPECT_EQ(planeAt(frame, planes, 0), &planes.plane(*planes.floor));
  EXPECT_TRUE(planeAt(frame, planes, 0.25)->isFloor);
}

}  // namespace quadmap
