#include "quadmap/surfaces/RoomPlanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

namespace quadmap
{
namespace
{
using mrpt::poses::CPose3D;

const CPose3D kSensor(1.0, -2.0, 1.4, 0.3, 0.4, 0.05);

SurfacePatch floorAt(double z, const CPose3D& T_map_sensor)
{
  const SurfacePatch floor_map = {
      SurfaceKind::Floor, {Eigen::Vector3d::UnitZ(), -z},
       {    }
  };
  return transformed(floor_map, -T_map_sensor);
}

/** A table top or the like with a point every 5 cm. */
SurfacePatch topAt(double x1, double y1, double x2, double y2, double z)
{
  SurfacePatch out = {
      SurfaceKind::Horizontal, {Eigen::Vector3d::UnitZ(), -z},
       {    }
  };
  for (int i = 0; x1 + 0.05 * i < x2; ++i)
    for (int j = 0; y1 + 0.05 * j < y2; ++j)
      out.samples.emplace_back(
          static_cast<float>(x1 + 0.05 * i), static_cast<float>(y1 + 0.05 * j),
          static_cast<float>(z));
  return out;
}

/** A wall with its foot at (x, y), facing `angle`. */
SurfacePatch wallAt(double x, double y, double angle)
{
  const Eigen::Vector3d n(std::cos(angle), std::sin(angle), 0), along(-n.y(), n.x(), 0);
  const Eigen::Vector3d foot(x, y, 0);
  SurfacePatch out = {SurfaceKind::Wall, Plane::throughPoint(n, foot), {}};
  for (int i = -10; i < 10; ++i)
    for (int j = 0; j < 20; ++j)
      out.samples.push_back(
          (foot + 0.1 * i * along + 0.1 * j * Eigen::Vector3d::UnitZ()).cast<float>());
  return out;
}

void show(RoomPlanes& room, const std::vector<SurfacePatch>& patches_map, const CPose3D& sensor)
{
  FrameSurfaces frame;
  for (const auto& patch : patches_map) frame.seen.push_back(transformed(patch, -sensor));
  room.add(frame, sensor);
}

void showFloor(RoomPlanes& room, double z, const CPose3D& sensor = kSensor)
{
  room.add({{floorAt(z, sensor)}, {}}, sensor);
}

double spanX(const SurfacePatch& patch)
{
  float low = 1e9f, high = -1e9f;
  for (const auto& p : patch.samples)
  {
    low = std::min(low, p.x());
    high = std::max(high, p.x());
  }
  return high - low;
}

TEST(RoomPlanes, KnowsNoFloorBeforeSeveralFramesAgree)
{
  RoomPlanes room;
  EXPECT_FALSE(room.floorHeight());
  showFloor(room, 0.0);
  showFloor(room, 0.01);
  EXPECT_FALSE(room.floorHeight());
  showFloor(room, 0.02);
  ASSERT_TRUE(room.floorHeight());
  EXPECT_NEAR(*room.floorHeight(), 0.01, 1e-9);
}

TEST(RoomPlanes, PrefersTheLowestFloorSeveralFramesAgreeOn)
{
  RoomPlanes room;
  for (int i = 0; i < 30; ++i) showFloor(room, 0.75);  // table tops that filled the image
  for (int i = 0; i < 5; ++i) showFloor(room, 0.0);
  showFloor(room, -0.9);  // one reflection below the floor
  EXPECT_NEAR(*room.floorHeight(), 0.0, 1e-9);
}

TEST(RoomPlanes, TakesTheFloorOfTheStoreyItIsOn)
{
  RoomPlanes room;
  const CPose3D upstairs(1.0, -2.0, 1.4 + 2.8, 0.3, 0.4, 0);
  for (int i = 0; i < 100; ++i) showFloor(room, 0.0);
  for (int i = 0; i < 3; ++i) showFloor(room, 2.8, upstairs);
  EXPECT_NEAR(*room.floorHeight(), 2.8, 1e-9);
  showFloor(room, 0.0);  // back downstairs
  EXPECT_NEAR(*room.floorHeight(), 0.0, 1e-9);
}

TEST(RoomPlanes, ForgetsAFloorItSawLongAgo)
{
  RoomPlanes room;  // odometry that drifts upwards
  for (int i = 0; i < 400; ++i) showFloor(room, 0.002 * i, CPose3D(0, 0, 1.4 + 0.002 * i, 0, 0, 0));
  EXPECT_NEAR(*room.floorHeight(), 0.798, 0.4);
  EXPECT_GT(*room.floorHeight(), 0.35);
}

TEST(RoomPlanes, GivesUpAFloorThatMoreFramesContradict)
{
  FrameSurfaces below;
  below.contradictsFloor = true;
  for (const int shown : {3, 10})
  {
    RoomPlanes room;
    for (int i = 0; i < shown; ++i) showFloor(room, 0.75);  // the top of a table
    for (int i = 1; i < shown; ++i) room.add(below, kSensor);
    EXPECT_NEAR(room.floorHeight().value_or(NAN), 0.75, 1e-9) << "as many showed it";
    EXPECT_EQ(room.droppedFloors(), 0U);
    room.add(below, kSensor);
    EXPECT_FALSE(room.floorHeight());
    EXPECT_EQ(room.droppedFloors(), 1U);
    room.add(below, kSensor);  // there is none left to contradict
    EXPECT_EQ(room.droppedFloors(), 1U);
    for (int i = 0; i < 3; ++i) showFloor(room, 0.0);
    EXPECT_NEAR(room.floorHeight().value_or(NAN), 0.0, 1e-9);
  }
}

TEST(RoomPlanes, KeepsAFloorThatAFewFramesContradict)
{
  RoomPlanes room;
  FrameSurfaces below;  // down a flight of stairs
  below.contradictsFloor = true;
  for (int i = 0; i < 100; ++i) showFloor(room, 0.0);
  for (int i = 0; i < 40; ++i) room.add(below, kSensor);
  EXPECT_NEAR(room.floorHeight().value_or(NAN), 0.0, 1e-9);
  EXPECT_EQ(room.droppedFloors(), 0U);
}

TEST(RoomPlanes, TakesForFurnitureWhatManyFramesSaidOf)
{
  for (const auto& [frames, saying, isFurniture] : {
           std::tuple{ 5, 1, false},
           { 5, 2,  true},
           {20, 3, false},
           {20, 5,  true}
  })
  {
    RoomPlanes room;
    for (int i = 0; i < frames; ++i)
    {
      SurfacePatch top = topAt(2, -0.5, 3, 0.5, 0.5);
      top.isFurniture = i < saying;
      show(room, {top}, kSensor);
    }
    ASSERT_EQ(room.around(kSensor).size(), 1U);
    EXPECT_EQ(room.around(kSensor)[0].isFurniture, isFurniture) << saying << " of " << frames;
  }
}

TEST(RoomPlanes, IgnoresFloorsThatAreNotLevel)
{
  RoomPlanes room;
  SurfacePatch wall = wallAt(-3, 0, 0);
  wall.kind = SurfaceKind::Floor;
  for (int i = 0; i < 10; ++i) show(room, {wall}, kSensor);
  EXPECT_FALSE(room.floorHeight());
}

TEST(RoomPlanes, GivesTheFloorInTheSensorFrame)
{
  RoomPlanes room;
  for (int i = 0; i < 3; ++i) showFloor(room, 0.2);
  const auto known = room.around(kSensor);
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known[0].kind, SurfaceKind::Floor);
  const auto p = transformed(Eigen::Vector3f(5.0f, 4.0f, 0.2f), -kSensor);
  EXPECT_NEAR(known[0].plane.signedDistance(p.cast<double>()), 0.0, 1e-5) << "single precision";
}

TEST(RoomPlanes, AveragesATableTopOverJitteringPoses)
{
  RoomPlanes room;
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  constexpr double kSigmaPosition = 0.014, kSigmaAngle = 0.8 * M_PI / 180;
  for (int i = 0; i < 40; ++i)
  {
    // What is seen is right in the sensor's frame; the map gets it from a wrong pose.
    FrameSurfaces frame;
    frame.seen.push_back(
        transformed(topAt(2.4, -0.6, 3.6, 0.6, 0.74), -CPose3D(0, 0, 1.4, 0, 0.4, 0)));
    room.add(
        frame, CPose3D(
                   kSigmaPosition * normal(generator), kSigmaPosition * normal(generator),
                   1.4 + kSigmaPosition * normal(generator), kSigmaAngle * normal(generator),
                   0.4 + kSigmaAngle * normal(generator), kSigmaAngle * normal(generator)));
  }
  const auto surfaces = room.surfaces();
  ASSERT_EQ(surfaces.size(), 1U) << "one table, not one per pose";
  // At 3 m one frame's height has a sigma of 4.5 cm; some ten of them count.
  EXPECT_NEAR(-surfaces[0].plane.d, 0.74, 0.03);
  EXPECT_NEAR(spanX(surfaces[0]), 1.2, 0.2) << "its rim by a cell and a few centimetres";
}

TEST(RoomPlanes, KeepsATrayApartFromItsTableAndDoesNotKeepABook)
{
  for (const double size : {0.5, 0.3})
  {
    RoomPlanes room;
    for (int i = 0; i < 5; ++i)
      show(room, {topAt(2, -0.5, 3.2, 0.5, 0.74), topAt(2.4, 0, 2.4 + size, size, 0.79)}, kSensor);
    const auto surfaces = room.surfaces();
    ASSERT_EQ(surfaces.size(), size > 0.4 ? 2U : 1U);
    EXPECT_NEAR(-surfaces[0].plane.d, 0.74, 1e-6);
    EXPECT_NEAR(-surfaces.back().plane.d, size > 0.4 ? 0.79 : 0.74, 1e-6);
  }
}

TEST(RoomPlanes, KeepsTablesOfEqualHeightApart)
{
  RoomPlanes room;
  for (int i = 0; i < 5; ++i)
    show(room, {topAt(1, -0.5, 2, 0.5, 0.74), topAt(2.8, -0.5, 3.8, 0.5, 0.74)}, kSensor);
  EXPECT_EQ(room.surfaces().size(), 2U);
}

TEST(RoomPlanes, JoinsThePartsOfATableThatFramesShow)
{
  RoomPlanes room;
  for (int i = 0; i < 4; ++i) show(room, {topAt(2.0, -0.5, 2.8, 0.5, 0.74)}, kSensor);
  for (int i = 0; i < 4; ++i) show(room, {topAt(2.5, -0.5, 3.6, 0.5, 0.75)}, kSensor);
  const auto surfaces = room.surfaces();
  ASSERT_EQ(surfaces.size(), 1U);
  EXPECT_NEAR(spanX(surfaces[0]), 1.6, 0.15);
}

TEST(RoomPlanes, TakesBackWhatAFrameLooksThrough)
{
  RoomPlanes room;
  for (int i = 0; i < 5; ++i) show(room, {topAt(2, -0.5, 3, 0.5, 0.74)}, kSensor);
  ASSERT_EQ(room.around(kSensor).size(), 1U);
  for (int i = 0; i < 5; ++i)  // the table was carried away
  {
    FrameSurfaces frame;
    for (const auto& known : room.around(kSensor))
      frame.seenThrough.insert(frame.seenThrough.end(), known.samples.begin(), known.samples.end());
    room.add(frame, kSensor);
  }
  EXPECT_TRUE(room.around(kSensor).empty());
}

TEST(RoomPlanes, DoesNotBelieveASurfaceSeenOnce)
{
  RoomPlanes room;
  show(room, {topAt(2, -0.5, 3, 0.5, 0.4)}, kSensor);
  for (int i = 0; i < 50; ++i) show(room, {topAt(2, -0.5, 3, 0.5, 0.74)}, kSensor);
  ASSERT_EQ(room.surfaces().size(), 1U);
  EXPECT_NEAR(-room.surfaces()[0].plane.d, 0.74, 1e-6);
}

TEST(RoomPlanes, ConfirmsWalls)
{
  RoomPlanes room;
  const double heading = 20 * M_PI / 180;
  for (int i = 0; i < 4; ++i)
    show(
        room, {wallAt(-3, 0, heading + 0.01), wallAt(0, 3, heading - M_PI / 2 - 0.01)},
        CPose3D(0, 0, 1.4, 0, 0, 0));
  ASSERT_EQ(room.surfaces().size(), 2U);
  for (const auto& surface : room.surfaces()) EXPECT_EQ(surface.kind, SurfaceKind::Wall);
}

TEST(RoomPlanes, LeavesOutWhatIsOutOfReach)
{
  RoomPlanes room;
  for (int i = 0; i < 4; ++i) show(room, {topAt(2, -0.5, 3, 0.5, 0.74)}, kSensor);
  EXPECT_TRUE(room.around(CPose3D(30, 0, 1.4, 0, 0, 0)).empty());
}

TEST(RoomPlanes, ForgetsRoomsLeftLongAgo)
{
  RoomPlanes room;
  for (int i = 0; i < 4; ++i) show(room, {topAt(2, -0.5, 3, 0.5, 0.74)}, kSensor);
  for (int i = 0; i < 1100; ++i) room.add({}, CPose3D(30, 0, 1.4, 0, 0, 0));
  EXPECT_TRUE(room.surfaces().empty());
}

}  // namespace
}  // namespace quadmap
