#include "Tables.h"

namespace quadmap::simulator
{
namespace
{
constexpr double kAboveTables = 0.9;  // free height above a table [m]

/** The square that fits into a round top of some diameter, or the rectangle of the others. */
Shelf topOf(const Eigen::Vector2d& size, double height, bool round)
{
  return {
      {0, 0},
      size * (round ? 0.35 : 0.48), height, kAboveTables
  };
}

void addTop(
    SceneObject& table,
    const Eigen::Vector2d& size,
    double height,
    double thick,
    bool round,
    std::size_t material)
{
  const Eigen::Vector3d center(0, 0, height - thick / 2), full(size.x(), size.y(), thick);
  if (round)
    addCylinder(table, center, full, material);
  else
    addBox(table, center, full, material);
}

/** Boards under the rim of a top that hold the legs together. */
void addApron(SceneObject& table, const Eigen::Vector2d& reach, double top, std::size_t wood)
{
  for (const double side : {-1, 1})
  {
    addBox(table, {side * reach.x(), 0, top - 0.04}, {0.02, 2 * reach.y(), 0.08}, wood);
    addBox(table, {0, side * reach.y(), top - 0.04}, {2 * reach.x(), 0.02, 0.08}, wood);
  }
}

/** Drawers below a desk's top at one side; the place where one sits stays free. */
void addDrawers(
    SceneObject& desk, const Eigen::Vector2d& size, double below, double side, std::size_t material)
{
  const double width = 0.38, depth = size.x() - 0.12;
  addBox(
      desk, {0, side * (size.y() / 2 - width / 2 - 0.03), below / 2 + 0.02},
      {depth, width, below - 0.04}, material);
}

}  // namespace

Furniture diningTable(FurnitureKit& kit)
{
  Furniture table{objectOf("dining table"), {}};
  const bool round = kit.chance(0.3);
  Eigen::Vector2d size{kit.between(1.1, 1.9), kit.between(0.75, 1.0)};
  if (round) size.setConstant(kit.between(0.85, 1.3));
  if (!round && kit.chance(0.2)) size.x() = size.y();
  table.object.orientationDefined = !round;
  const double height = kit.between(0.71, 0.78), thick = kit.between(0.02, 0.045);
  const double below = height - thick;
  const std::size_t wood = kit.wood(), leg = kit.chance(0.7) ? wood : kit.metal();
  addTop(table.object, size, height, thick, round, wood);
  if (round && kit.chance(0.6))
  {
    addCylinder(table.object, {0, 0, below / 2}, {0.12, 0.12, below}, leg);
    addCylinder(table.object, {0, 0, 0.02}, {0.5 * size.x(), 0.5 * size.y(), 0.04}, leg);
  }
  else if (!round && kit.chance(0.25))  // on boards at both ends
    for (const double side : {-1, 1})
      addBox(
          table.object, {side * (size.x() / 2 - 0.2), 0, below / 2}, {0.05, size.y() - 0.2, below},
          leg);
  else
  {
    const Eigen::Vector2d reach = round
                                      ? Eigen::Vector2d(0.3 * size)
                                      : Eigen::Vector2d{size.array() / 2 - kit.between(0.05, 0.1)};
    if (!round && kit.chance(0.6)) addApron(table.object, reach, below, wood);
    const bool roundLegs = kit.chance(0.3);
    addLegs(table.object, reach, below, kit.between(0.04, 0.08), roundLegs, leg);
  }
  table.shelves.push_back(topOf(size, height, round));
  return table;
}

Furniture desk(FurnitureKit& kit)
{
  Furniture desk{objectOf("desk"), {}};
  const Eigen::Vector2d size{kit.between(0.6, 0.85), kit.between(1.15, 1.8)};
  const double height = kit.between(0.7, 0.77), thick = kit.between(0.02, 0.04);
  const double below = height - thick, side = kit.chance(0.5) ? 1 : -1;
  const std::size_t top = kit.chance(0.5) ? kit.lacquer() : kit.wood();
  const std::size_t frame = kit.chance(0.5) ? kit.metal() : top;
  addTop(desk.object, size, height, thick, false, top);
  if (kit.chance(0.4))
    for (const double y : {-1, 1})
      addBox(
          desk.object, {0, y * (size.y() / 2 - 0.03), below / 2}, {size.x() - 0.06, 0.04, below},
          frame);
  else
    addLegs(desk.object, size.array() / 2 - 0.04, below, kit.between(0.04, 0.06), false, frame);
  if (kit.chance(0.5))
    addBox(
        desk.object, {-size.x() / 2 + 0.08, 0, below - 0.18}, {0.02, size.y() - 0.12, 0.36}, frame);
  if (kit.chance(0.5)) addDrawers(desk.object, size, below, side, frame);
  desk.shelves.push_back(topOf(size, height, false));
  // The floor beside the place where one sits, away from the drawers.
  desk.shelves.push_back({
      {0.02, -side * (size.y() / 2 - 0.22)},
      {0.24,                          0.14},
      0, below - 0.02
  });
  return desk;
}

Furniture coffeeTable(FurnitureKit& kit)
{
  Furniture table{objectOf("coffee table"), {}};
  const bool round = kit.chance(0.25), glass = kit.chance(0.1);
  Eigen::Vector2d size{kit.between(0.45, 0.65), kit.between(0.8, 1.25)};
  if (round) size.setConstant(kit.between(0.55, 0.85));
  table.object.orientationDefined = !round;
  const double height = kit.between(0.34, 0.5), thick = kit.between(0.02, 0.05);
  const std::size_t wood = kit.wood(), top = glass ? kit.glass() : wood;
  addTop(table.object, size, height, thick, round, top);
  const Eigen::Vector2d reach = (round ? 0.3 : 0.44) * size;
  if (glass) addApron(table.object, reach, height - thick, wood);
  addLegs(table.object, reach, height - thick, 0.045, kit.chance(0.4), wood);
  table.shelves.push_back(topOf(size, height, round));
  if (kit.chance(0.4))
  {
    addBox(table.object, {0, 0, 0.13}, {2 * reach.x(), 2 * reach.y(), 0.02}, wood);
    table.shelves.push_back({
        {0, 0},
        0.8 * reach, 0.14, height - thick - 0.15
    });
  }
  return table;
}

}  // namespace quadmap::simulator
