#include "quadmap/navigation/ApproachPose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <queue>
#include <set>

#include "../base/OptionGroupLaws.h"
#include "../maps/SyntheticScene.h"
#include "quadmap/maps/CQuadricObjectMap.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPose2D;

namespace
{
/** A living room of 6 m x 6 m, its middle at the origin. */
class LivingRoom : public ::testing::Test
{
 protected:
  LivingRoom()
  {
    tv = add(cuboid("tv", {0, 2.6, 0.8}, {1.0, 0.1, 0.6}, 0));
    add(cuboid("cabinet", {0, 2.6, 0.25}, {1.4, 0.4, 0.5}, 0));
    table = add(cuboid("dining table", {0.3, -0.2, 0.375}, {1.4, 0.9, 0.75}, 0.3));
    bed = add(cuboid("bed", {-2.2, -1.5, 0.3}, {1.4, 2.0, 0.6}, 0));
    chair = add(cuboid("chair", {2.2, 1.0, 0.45}, {0.5, 0.5, 0.9}, 0.1));
    lamp = add(cuboid("clock", {1.5, -1.8, 2.0}, {0.4, 0.4, 0.2}, 0));
    cup = add(cuboid("cup", {-2.0, 1.2, 0.05}, {0.1, 0.1, 0.1}, 0), false);
    grid.setSize(-3, 3, -3, 3, 0.05F, 0.98F);
    footprintInto(map, grid);
  }

  ObjectId add(const TrueObject& truth, bool directed = true)
  {
    MapObject object;
    object.object = truth.object;
    object.covariance = 1e-4 * UprightCovariance::Identity();
    object.labelCounts[truth.label] = 20;
    object.completeCount = 20;
    object.existenceLogOdds = 8;
    object.orientationDefined = directed;
    return map.addObject(object);
  }

  /** Marks a box of the grid as occupied [m]. */
  void block(float x0, float x1, float y0, float y1)
  {
    for (float x = x0; x <= x1; x += 0.05F)
      for (float y = y0; y <= y1; y += 0.05F) grid.setPos(x, y, 0.02F);
  }

  /** No occupied or unknown cell is within the radius of the robot: brute force over all cells. */
  bool isFree(const TPose2D& pose) const
  {
    for (unsigned y = 0; y < grid.getSizeY(); ++y)
      for (unsigned x = 0; x < grid.getSizeX(); ++x)
        if (grid.getCell(static_cast<int>(x), static_cast<int>(y)) < 0.55F &&
            std::hypot(grid.idx2x(x) - pose.x, grid.idx2y(y) - pose.y) < options.robotRadius)
          return false;
    return true;
  }

  /** Distance from the footprint of an object to a place, from its own coordinates [m]. */
  double distanceTo(ObjectId id, const TPose2D& pose) const
  {
    const auto& object = map.find(id)->object;
    const mrpt::math::TPoint3D p =
        object.pose().inverseComposePoint(mrpt::math::TPoint3D(pose.x, pose.y, 0));
    const double dx = std::max(0.0, std::abs(p.x) - object.semiAxes().x());
    const double dy = std::max(0.0, std::abs(p.y) - object.semiAxes().y());
    return std::hypot(dx, dy);
  }

  std::optional<ApproachPose> approach(ObjectId id, const TPose2D& robot) const
  {
    const auto found = approachPose(map, id, robot, grid, options);
    EXPECT_TRUE(!found || isFree(found->pose));
    return found;
  }

  CQuadricObjectMap map;
  COccupancyGridMap2D grid;
  DrivingOptions options;
  ObjectId tv, table, bed, chair, lamp, cup;
};

}  // namespace

TEST_F(LivingRoom, ScreensAreApproachedFromTheFrontBeyondWhatTheyStandOn)
{
  const auto found = approach(tv, {-2, 2, 0});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->isUsualSide);
  EXPECT_LT(found->pose.y, 2.4 - options.robotRadius + 0.025)
      << "[m], before the cabinet, to half a cell";
  EXPECT_GT(found->pose.y, 1.5);
  EXPECT_NEAR(found->pose.x, 0, 0.3);
  EXPECT_NEAR(found->pose.phi, M_PI / 2, 1e-6) << "it looks at the screen";
}

TEST_F(LivingRoom, ChairsAreApproachedFromWhereTheRoomIs)
{
  const auto found = approach(chair, {2.7, -2.5, 0});
  ASSERT_TRUE(found);
  EXPECT_LT(found->pose.x, 2.0) << "on the side of the middle";
  EXPECT_NEAR(std::abs(found->pose.phi), 0.1, 1e-6);
  EXPECT_NEAR(distanceTo(chair, found->pose), options.gap + options.robotRadius, 0.06);
}

TEST_F(LivingRoom, ChairsAtATableAreApproachedFromBesideOrBehind)
{
  const ObjectId drawnUp = add(cuboid("chair", {0.1, 0.6, 0.45}, {0.5, 0.5, 0.9}, 0.3));
  footprintInto(map, grid);
  for (const TPose2D& robot : {TPose2D(0.3, -2.5, 0), TPose2D(2.6, 0, 0), TPose2D(-1.2, 0, 0)})
  {
    const auto found = approach(drawnUp, robot);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->isUsualSide);
    EXPECT_LT(distanceTo(drawnUp, found->pose), 0.9) << "[m], not beyond the table";
  }
}

TEST_F(LivingRoom, BedsAreApproachedFromTheNearerLongSide)
{
  const auto found = approach(bed, {0, -2.5, 0});
  ASSERT_TRUE(found);
  EXPECT_GT(found->pose.x, -1.5)
      << "the long side, which runs along y, and not its foot at y = -0.5";
  EXPECT_NEAR(std::abs(found->pose.phi), M_PI, 1e-6);
}

TEST_F(LivingRoom, TablesAreApproachedFromAnySide)
{
  std::set<int> sides;
  for (const TPose2D& robot :
       {TPose2D(2.6, -0.2, 0), TPose2D(-1.2, -0.2, 0), TPose2D(0.3, -2.5, 0), TPose2D(0.3, 1.5, 0)})
  {
    const auto found = approach(table, robot);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->isUsualSide);
    EXPECT_NEAR(distanceTo(table, found->pose), options.gap + options.robotRadius, 0.06);
    EXPECT_LT(found->way, std::hypot(robot.x - 0.3, robot.y + 0.2) + 0.3) << "the nearest side";
    sides.insert(static_cast<int>(std::lround(found->pose.phi * 2 / M_PI)));
  }
  EXPECT_EQ(sides.size(), 4u);
}

TEST_F(LivingRoom, RoundThingsAreApproachedFromTheRobotsSide)
{
  const auto found = approach(cup, {2.5, 2.0, 0});
  ASSERT_TRUE(found);
  EXPECT_GT(found->pose.x, -2.0);
}

TEST_F(LivingRoom, AnotherSideServesWhenTheFrontIsBlocked)
{
  block(-0.3F, 1.9F, -0.6F, 2.3F);
  const auto found = approach(chair, {2.6, -2.5, 0});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->isUsualSide);
  EXPECT_GT(found->pose.x, 1.9);
}

TEST_F(LivingRoom, WhatCannotBeReachedHasNoPose)
{
  block(-3, 3, 0.6F, 0.7F);  // a wall through the room
  EXPECT_FALSE(approach(tv, {0, -2.5, 0}));
  EXPECT_TRUE(approach(tv, {-2.5, 1.5, 0}));
}

TEST_F(LivingRoom, UnknownCellsAreNotFree)
{
  grid.fill(0.5F);
  EXPECT_FALSE(approach(table, {2.6, -0.2, 0}));
}

TEST_F(LivingRoom, ARobotThatTouchesSomethingCanLeave)
{
  const auto found = approach(tv, {-1.45, -1.5, 0});  // 5 cm from the bed
  EXPECT_TRUE(found);
}

TEST_F(LivingRoom, UnknownObjectsAreAnError)
{
  EXPECT_THROW(approachPose(map, 999, {}, grid), std::out_of_range);
}

TEST_F(LivingRoom, FootprintsCoverTheAreaOfTheObjects)
{
  COccupancyGridMap2D empty;
  empty.setSize(-3, 3, -3, 3, 0.02F, 0.98F);
  const std::size_t cells = footprintInto(map, empty);
  const double area = static_cast<double>(cells) * 0.02 * 0.02;
  // Tv and cabinet overlap, and the cells of both are written; the clock hangs above the robot.
  // What is touched is more than the objects by up to a cell along their outlines.
  const double objects = 0.1 + 0.56 + 1.26 + 2.8 + 0.25 + 0.01, around = 19.6;
  EXPECT_GT(area, objects) << "[m^2]";
  EXPECT_LT(area, objects + 0.02 * around) << "[m^2]";
  EXPECT_LT(empty.getPos(0.3F, -0.2F), 0.1F);
  EXPECT_GT(empty.getPos(1.5F, -1.8F), 0.9F) << "below the clock";
  DrivingOptions tall;
  tall.robotHeight = 2.5;
  footprintInto(map, empty, tall);
  EXPECT_LT(empty.getPos(1.5F, -1.8F), 0.1F);
}

TEST_F(LivingRoom, APlaceBesideTheRobotMustBeFreeToo)
{
  block(1.30F, 1.36F, 0.9F, 1.1F);  // too near to where one stands before the chair
  EXPECT_TRUE(approach(chair, {1.55, 0.95, 0}));
}

TEST_F(LivingRoom, ARobotBesideTheGridHasNoWay) { EXPECT_FALSE(approach(tv, {-3.02, 1.5, 0})); }

TEST_F(LivingRoom, TheEdgeOfTheGridIsAnObstacle)
{
  // One stands 0.45 m from the middle of a cup, 5 cm from the edge if the robot were there.
  const ObjectId ball = add(cuboid("cup", {0, 0, 0.05}, {0.1, 0.1, 0.1}, 0), false);
  grid.setSize(-3, 0.5F, -3, 3, 0.05F, 0.98F);
  const auto found = approach(ball, {0.45, 0, 0});
  ASSERT_TRUE(found);
  EXPECT_LT(found->pose.x, 0.5 - options.robotRadius + 0.05);
}

TEST(Footprints, HoldWhatIsThinnerThanACell)
{
  for (const double yaw : {0.0, 0.5, 1.2})
  {
    CQuadricObjectMap map;
    MapObject tv;
    tv.object = cuboid("tv", {0.03, 0.04, 0.5}, {1.6, 0.02, 0.6}, yaw).object;
    tv.labelCounts["tv"] = tv.completeCount = 20;
    tv.covariance = 1e-4 * UprightCovariance::Identity();
    tv.existenceLogOdds = 8;
    map.addObject(tv);
    COccupancyGridMap2D grid;
    grid.setSize(-1, 1, -1, 1, 0.1F, 0.98F);
    EXPECT_LT(footprintInto(map, grid), 16u * 3);
    for (double along = -0.79; along < 0.8; along += 0.01)
      EXPECT_LT(
          grid.getPos(
              static_cast<float>(0.03 + along * std::cos(yaw)),
              static_cast<float>(0.04 + along * std::sin(yaw))),
          0.1F)
          << yaw << " rad, " << along << " m";
  }
}

TEST(Footprints, LeaveASmallerGridItsSize)
{
  CQuadricObjectMap map;
  COccupancyGridMap2D grid;
  grid.setSize(-1, 1, -1, 1, 0.05F, 0.98F);
  EXPECT_EQ(footprintInto(map, grid), 0u);
  EXPECT_EQ(grid.getSizeX(), 40u);
}

TEST(DrivingOptions, KeepTheLawsOfOptions) { expectLaws<DrivingOptions>("driving"); }
