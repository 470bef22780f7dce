#include <cmath>

#include "RoomSteps.h"
#include "RoomZones.h"
#include "Seats.h"
#include "SmallThings.h"
#include "WallThings.h"

namespace quadmap::simulator
{
namespace
{
/** Sizes in whole centimetres. */
double centimetres(double value) { return std::round(100 * value) / 100; }

void drawShell(Scene& scene, FurnitureKit& kit)
{
  scene.room.size = {
      centimetres(kit.between(4.6, 7.6)), centimetres(kit.between(4.0, 6.2)),
      centimetres(kit.between(2.4, 3.0))};
  scene.room.floor = kit.floor();
  scene.room.walls = kit.wallpaper();
  scene.room.ceiling = kit.ceiling();
}

/** A corner of the room that belongs to the next one, or a pillar at a wall. */
void addCorner(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  const Eigen::Vector3d size = room.scene().room.size;
  const bool pillar = kit.chance(0.5);
  const Eigen::Vector2d block = pillar
                                    ? Eigen::Vector2d{kit.between(0.3, 0.5), kit.between(0.3, 0.6)}
                                    : Eigen::Vector2d{size.head<2>() * kit.between(0.2, 0.32)};
  SceneObject corner = objectOf("");
  addBox(
      corner, {0, 0, size.z() / 2}, {centimetres(block.x()), centimetres(block.y()), size.z()},
      room.scene().room.walls);
  const double x = (size.x() - centimetres(block.x())) / 2,
               y = (size.y() - centimetres(block.y())) / 2;
  const double alongWall = pillar ? kit.between(-y, y) : y;
  corner.T_world_obj = {
      kit.chance(0.5) ? x : -x, kit.chance(0.5) ? alongWall : -alongWall, 0, 0, 0, 0};
  room.put(corner);
}

void addDoor(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  const double width = kit.between(0.8, 0.95), height = kit.between(1.98, 2.1);
  const double opening = kit.chance(0.6) ? 0 : kit.between(0.3, 1.5);
  const SceneObject frame = doorFrame(kit, width, height);
  SceneObject leaf = doorLeaf(kit, width - 0.02, height - 0.01, opening);
  for (int i = 0; i < 20; ++i)
  {
    const std::size_t wall = kit.pick(4);
    const double reach = room.placeAtWall(wall, 0).length / 2 - width;
    const auto place = room.placeAtWall(wall, kit.between(-reach, reach)).T_world_place;
    SceneObject placed = frame;
    placed.T_world_obj = place + mrpt::poses::CPose3D(0.002, 0, 0, 0, 0, 0);
    if (!room.put(placed)) continue;
    leaf.T_world_obj =
        place + mrpt::poses::CPose3D(0.002, -width / 2 + 0.01, 0, 0, 0, 0) + leaf.T_world_obj;
    room.put(leaf);
    const auto front = place + mrpt::poses::CPose3D(0.55, 0, 0, 0, 0, 0);
    room.keepFree({
        {front.x(), front.y()},
        {     0.55, width / 2},
        place.yaw(), 0, 1.9
    });
    return;
  }
}

/** Hangs a thing up, its lower edge at a height between two [m]. */
void putOnWall(RoomBuilder& room, SceneObject (*make)(FurnitureKit&), double low, double high)
{
  const double height = room.kit().between(low, high);
  room.putAtWall(make(room.kit()), 0, height, 0.002);
}

void addOnWalls(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  for (int i = kit.whole(0, 2); i > 0; --i) putOnWall(room, &window, 0.8, 1.0);
  for (int i = kit.whole(1, 4); i > 0; --i) putOnWall(room, &picture, 1.1, 1.5);
  if (kit.chance(0.4)) putOnWall(room, &wallClock, 1.6, 1.9);
  if (kit.chance(0.4)) room.putAtWall(radiator(kit), 0);
}

void addLooseThings(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  for (int i = kit.whole(0, 2); i > 0; --i) room.putOnTheFloor(floorPlant(kit));
  for (int i = kit.whole(1, 4); i > 0; --i) room.putOnTheFloor(floorThing(kit));
  if (kit.chance(0.4)) room.putOnTheFloor(stool(kit));
  if (kit.chance(0.5)) room.putOnTheFloor(diningChair(kit));
  if (kit.chance(0.3)) room.putInTheMiddle(person(kit), 0.1);
}

}  // namespace

void furnishRoom(Scene& scene, FurnitureKit& kit)
{
  drawShell(scene, kit);
  RoomBuilder room(scene, kit);
  if (kit.chance(0.4)) addCorner(room);
  addDoor(room);
  using Zone = void (*)(RoomBuilder&);
  const std::vector<Zone> themes[] = {
      {       addLounge, addDiningPlace,     addStorage},
      {    addWorkPlace,   addWorkPlace,     addStorage,addStorage},
      {addSleepingPlace,     addStorage,   addWorkPlace              },
      {   addKitchenRow, addDiningPlace,     addStorage},
      {       addLounge,   addWorkPlace, addDiningPlace              }
  };
  for (const Zone zone : themes[kit.pick(std::size(themes))]) zone(room);
  if (kit.chance(0.4)) addStorage(room);
  addOnWalls(room);
  addLooseThings(room);
}

}  // namespace quadmap::simulator
