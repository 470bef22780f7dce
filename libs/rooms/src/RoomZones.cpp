#include "RoomZones.h"

#include <mrpt/poses/CPose2D.h>

#include <algorithm>
#include <cmath>

#include "Screens.h"
#include "Seats.h"
#include "SmallThings.h"
#include "Storage.h"
#include "Tables.h"
#include "WallThings.h"

namespace quadmap::simulator
{
namespace
{
/** Half sizes of an object in its own frame [m]. */
Eigen::Vector3d halfOf(const SceneObject& object) { return object.truth().semiAxes(); }

/** x of the rear end of a piece in its own frame [m]. */
double backOf(SceneObject object)
{
  object.T_world_obj = {};
  const UprightBox box = boundsOf(object);
  return box.center.x() - box.half.x();
}

void addSmallThings(RoomBuilder& room, std::size_t piece, const Shelf& shelf, int count)
{
  for (int i = 0; i < count; ++i)
    room.putOnShelf(smallThing(room.kit(), room.kit().pick(smallKinds())), piece, shelf);
}

/** A chair at a table. \param seat Middle of the table's edge there, and the direction from the
 * table outwards as its yaw, in the frame of the table. It is pushed in as far as it goes, or
 * stands farther out, or is turned. */
void addChairAt(
    RoomBuilder& room,
    std::size_t table,
    const SceneObject& chair,
    const mrpt::poses::CPose2D& seat)
{
  FurnitureKit& kit = room.kit();
  const double depth = 2 * halfOf(chair).x();
  double out = kit.chance(0.5) ? kit.between(-0.3, -0.1) : kit.between(-0.1, 0.3);
  const double turn = kit.chance(0.15) ? kit.gaussian(0.6) : kit.gaussian(0.1);
  for (int i = 0; i < 6; ++i, out += 0.08)
  {
    const double d = out + depth / 2;
    const mrpt::poses::CPose3D place(
        seat.x() + d * std::cos(seat.phi()), seat.y() + d * std::sin(seat.phi()), 0,
        seat.phi() + M_PI + turn, 0, 0);
    if (room.putBeside(chair, table, place)) return;
  }
}

/** The places at a table: one for each 0.6 m of a long side, and the two ends. */
std::vector<mrpt::poses::CPose2D> seatsAt(const Eigen::Vector3d& half, bool round, double turn)
{
  std::vector<mrpt::poses::CPose2D> seats;
  if (round)
  {
    const int places = half.x() > 0.55 ? 5 : 3;
    for (int i = 0; i < places; ++i)
    {
      const double a = turn + 2 * M_PI * i / places;
      seats.emplace_back(half.x() * std::cos(a), half.x() * std::sin(a), a);
    }
    return seats;
  }
  const int along = std::max(1, static_cast<int>(half.x() / 0.33));
  for (int i = 0; i < along; ++i)
    for (const double side : {-1, 1})
      seats.emplace_back(
          2 * half.x() * ((i + 0.5) / along - 0.5), side * half.y(), side * M_PI / 2);
  for (const double side : {-1, 1}) seats.emplace_back(side * half.x(), 0, side > 0 ? 0 : M_PI);
  return seats;
}

void addLampAbove(RoomBuilder& room, std::size_t piece, double surface)
{
  const double height = room.scene().room.size.z();
  const double lower = std::max(1.5, surface + room.kit().between(0.75, 1.0));
  if (height - lower < 0.35) return;
  const HangingLamp lamp = hangingLamp(room.kit(), height - lower);
  const mrpt::poses::CPose3D ceiling(0, 0, height, 0, 0, 0);
  if (room.putBeside(lamp.shade, piece, ceiling)) room.putBeside(lamp.cord, piece, ceiling);
}

void addScreens(RoomBuilder& room, std::size_t piece, const Shelf& top)
{
  FurnitureKit& kit = room.kit();
  const double back = top.center.x() - top.half.x();
  if (kit.chance(0.3))
  {
    const double yaw = kit.gaussian(0.25);
    room.putOnShelf(laptop(kit), piece, top, yaw);
    return;
  }
  const StandingScreen screen = monitor(kit);
  const double width = 2 * halfOf(screen.whole).y();
  const int count = width < 0.9 * top.half.y() && kit.chance(0.45) ? 2 : 1;
  for (int i = 0; i < count; ++i)
  {
    const double y = count == 2 ? (i - 0.5) * (width + kit.between(0.03, 0.12)) : kit.gaussian(0.1);
    const double yaw = count == 2 ? (0.5 - i) * kit.between(0.1, 0.6) : kit.gaussian(0.15);
    const double x = back - backOf(screen.whole) + 0.1;
    if (const auto put = room.putBeside(screen.whole, piece, {x, y, top.z, yaw, 0, 0}))
      room.detach(*put, screen.panelParts);
  }
  const double front = top.center.x() + top.half.x();
  if (kit.chance(0.8))
  {
    const double y = kit.gaussian(0.05), yaw = kit.gaussian(0.08);
    room.putBeside(keyboard(kit), piece, {front - 0.15, y, top.z, yaw, 0, 0});
  }
  if (kit.chance(0.6))
  {
    const double yaw = kit.gaussian(0.2);
    room.putBeside(computerMouse(kit), piece, {front - 0.15, 0.36, top.z, yaw, 0, 0});
  }
}

/** Things in the compartments of a shelf: rows of books that count as one thing, and single ones.
 */
void fillCompartments(RoomBuilder& room, std::size_t piece, const std::vector<Shelf>& shelves)
{
  FurnitureKit& kit = room.kit();
  for (const auto& shelf : shelves)
  {
    if (kit.chance(0.25)) continue;
    if (kit.chance(0.5))
    {
      SceneObject row = objectOf("");
      const double height = std::min(shelf.headroom - 0.02, kit.between(0.2, 0.3));
      const double width = shelf.half.y() * kit.between(0.5, 1.2), depth = 1.6 * shelf.half.x();
      for (int i = 0; i < 6; ++i)
      {
        const double h = height * kit.between(0.8, 1.0);
        const std::size_t cover = kit.cover();
        addBox(
            row, {0, width * ((i + 0.5) / 6 - 0.5), h / 2},
            {depth * kit.between(0.8, 1), width / 6, h}, cover);
      }
      room.putOnShelf(row, piece, shelf, 0.0);
    }
    if (kit.chance(0.5)) addSmallThings(room, piece, shelf, 1);
    if (kit.chance(0.25)) room.putOnShelf(standingBook(kit), piece, shelf, 0.0);
  }
}

}  // namespace

void addDiningPlace(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  const Furniture table = diningTable(kit);
  auto index = room.putInTheMiddle(table.object, 0.6);
  if (!index) index = room.putInTheMiddle(table.object, 0.4);
  if (!index) return;
  const SceneObject chair = diningChair(kit), other = kit.chance(0.3) ? diningChair(kit) : chair;
  const double taken = kit.between(0.5, 1);
  const bool isRound = !table.object.orientationDefined;
  for (const auto& seat : seatsAt(halfOf(table.object), isRound, kit.between(0, M_PI)))
    if (kit.chance(taken)) addChairAt(room, *index, kit.chance(0.8) ? chair : other, seat);
  addSmallThings(room, *index, table.shelves.front(), kit.whole(1, 6));
  if (kit.chance(0.4)) addLampAbove(room, *index, table.shelves.front().z);
}

void addWorkPlace(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  const Furniture table = desk(kit);
  const auto index = room.putAtWall(table.object, 0, 0, kit.between(0.01, 0.12));
  if (!index) return;
  const Eigen::Vector3d half = halfOf(table.object);
  const SceneObject chair = kit.chance(0.7) ? officeChair(kit) : diningChair(kit);
  addChairAt(room, *index, chair, {half.x(), kit.gaussian(0.08), 0});
  const Shelf& top = table.shelves[0];
  addScreens(room, *index, top);
  if (kit.chance(0.4)) room.putOnShelf(tableLamp(kit), *index, top);
  if (kit.chance(0.2)) room.putOnShelf(printer(kit), *index, top, 0.0);
  addSmallThings(room, *index, top, kit.whole(1, 3));
  if (kit.chance(0.5))
    room.putOnShelf(computer(kit), *index, table.shelves[1], 0.0);
  else if (kit.chance(0.6))
    room.putOnShelf(floorThing(kit), *index, table.shelves[1]);
}

void addLounge(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  const SceneObject seat = couch(kit);
  auto index = kit.chance(0.75) ? room.putAtWall(seat, 0.3, 0, kit.between(0.01, 0.1))
                                : room.putInTheMiddle(seat, 0.35);
  if (!index) index = room.putAtWall(seat, 0);
  if (index)
  {
    const Furniture table = coffeeTable(kit);
    const double x = 0.4 + halfOf(seat).x() + kit.between(0.02, 0.2) + halfOf(table.object).x();
    if (const auto low = room.putBeside(
            table.object, *index, {x, kit.gaussian(0.2), 0, kit.gaussian(0.06), 0, 0}))
      for (const auto& shelf : table.shelves) addSmallThings(room, *low, shelf, kit.whole(0, 3));
  }
  if (kit.chance(0.5)) room.putInTheMiddle(armchair(kit), 0.2);
  if (kit.chance(0.3))
  {
    const double height = kit.between(0.85, 1.3);
    room.putAtWall(wallTelevision(kit), 0.8, height, 0.05);
  }
  else
  {
    const Furniture stand = screenStand(kit);
    const auto low = room.putAtWall(stand.object, 0.6);
    if (!low) return;
    const double yaw = kit.gaussian(0.05);
    const StandingScreen screen = television(kit);
    if (const auto put = room.putOnShelf(screen.whole, *low, stand.shelves[0], yaw))
      room.detach(*put, screen.panelParts);
    addSmallThings(room, *low, stand.shelves[0], kit.whole(0, 2));
  }
}

void addSleepingPlace(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  const SceneObject mattress = bed(kit);
  const auto index = room.putAtWall(mattress, 0, 0, kit.between(0.01, 0.05));
  if (!index) return;
  const Furniture stand = nightstand(kit);
  for (const double side : {-1, 1})
  {
    if (kit.chance(0.25)) continue;
    const double y =
        side * (halfOf(mattress).y() + halfOf(stand.object).y() + kit.between(0.02, 0.1));
    const double x = backOf(mattress) - backOf(stand.object);
    const auto low = room.putBeside(stand.object, *index, {x, y, 0, kit.gaussian(0.03), 0, 0});
    if (!low) continue;
    if (kit.chance(0.7)) room.putOnShelf(tableLamp(kit), *low, stand.shelves[0]);
    addSmallThings(room, *low, stand.shelves[0], kit.whole(0, 2));
  }
}

void addKitchenRow(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  std::vector<Furniture> row{kitchenBlock(kit), oven(kit), kitchenBlock(kit)};
  const Furniture cold = refrigerator(kit);
  row.insert(kit.chance(0.5) ? row.begin() : row.end(), cold);
  double width = 0;
  for (const auto& piece : row) width += 2 * halfOf(piece.object).y() + 0.01;
  for (int i = 0; i < 8; ++i)
  {
    const std::size_t wall = kit.pick(4);
    const double free = room.placeAtWall(wall, 0).length - width;
    if (free < 0.02) continue;
    double along = -width / 2 + kit.between(-free / 2, free / 2);
    int stands = 0;
    for (const auto& piece : row)
    {
      const double half = halfOf(piece.object).y();
      SceneObject object = piece.object;
      const auto place = room.placeAtWall(wall, along + half).T_world_place;
      along += 2 * half + 0.01;
      object.T_world_obj = place + mrpt::poses::CPose3D(0.015 - backOf(object), 0, 0, 0, 0, 0);
      const auto index = room.put(object, 0.7);
      if (!index) continue;
      ++stands;
      if (piece.shelves.empty() || object.label == "oven") continue;
      if (kit.chance(0.5)) room.putOnShelf(kitchenMachine(kit), *index, piece.shelves[0], 0.0);
      addSmallThings(room, *index, piece.shelves[0], kit.whole(0, 3));
      SceneObject above = wallCupboard(kit).object;
      above.T_world_obj = place + mrpt::poses::CPose3D(0.004 - backOf(above), 0, 1.45, 0, 0, 0);
      if (kit.chance(0.4) && halfOf(above).y() < half + 0.1) room.put(above);
    }
    if (stands > 0) return;
  }
}

void addStorage(RoomBuilder& room)
{
  FurnitureKit& kit = room.kit();
  if (kit.chance(0.5))
  {
    const Furniture piece = cabinet(kit);
    const auto index = room.putAtWall(piece.object, 0.45);
    if (index && !piece.shelves.empty())
      addSmallThings(room, *index, piece.shelves[0], kit.whole(0, 3));
    return;
  }
  const Furniture piece = bookshelf(kit);
  if (const auto index = room.putAtWall(piece.object, 0.45))
    fillCompartments(room, *index, piece.shelves);
}

}  // namespace quadmap::simulator
