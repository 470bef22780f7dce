#include "Storage.h"

#include <algorithm>
#include <cmath>

namespace quadmap::simulator
{
namespace
{
constexpr double kAbove = 0.6;        // free height above a piece of furniture [m]
constexpr double kHighestTop = 1.35;  // things stand on tops up to here [m]

/** Fronts of doors and drawers, a little proud of the body, in a grid. */
void addFronts(
    SceneObject& object,
    const Eigen::Vector3d& size,
    double bottom,
    int columns,
    int rows,
    std::size_t front,
    std::size_t grip)
{
  const double w = size.y() / columns, h = (size.z() - bottom) / rows;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
    {
      const Eigen::Vector3d at(
          size.x() / 2 + 0.008, w * (i + 0.5) - size.y() / 2, bottom + h * (j + 0.5));
      addBox(object, at, {0.016, w - 0.01, h - 0.01}, front);
      addBox(object, at + Eigen::Vector3d(0.018, 0, 0.2 * h), {0.02, 0.12, 0.015}, grip);
    }
}

/** A closed body with fronts, on feet or down to the floor. */
Furniture closedBody(
    FurnitureKit& kit, const std::string& label, const Eigen::Vector3d& size, int columns, int rows)
{
  Furniture piece{objectOf(label), {}};
  const std::size_t body = kit.chance(0.5) ? kit.wood() : kit.lacquer();
  const std::size_t front = kit.chance(0.5) ? body : kit.lacquer();
  const double bottom = kit.chance(0.4) ? kit.between(0.06, 0.15) : 0.0;
  addBox(
      piece.object, {0, 0, (bottom + size.z()) / 2}, {size.x(), size.y(), size.z() - bottom}, body);
  if (bottom > 0)
    addLegs(
        piece.object, {size.x() / 2 - 0.04, size.y() / 2 - 0.04}, bottom, 0.04, true, kit.metal());
  addFronts(piece.object, size, bottom, columns, rows, front, kit.metal());
  if (size.z() < kHighestTop)
    piece.shelves.push_back({
        {              0,               0},
        {0.46 * size.x(), 0.48 * size.y()},
        size.z(), kAbove
    });
  return piece;
}

}  // namespace

Furniture cabinet(FurnitureKit& kit)
{
  const double depth = kit.between(0.35, 0.6), width = kit.between(0.5, 1.5);
  const double height = kit.chance(0.3) ? kit.between(1.7, 2.1) : kit.between(0.65, 1.25);
  const int columns = std::max(1, static_cast<int>(std::lround(width / 0.5)));
  const int rows = height > 1.5 ? 1 : kit.whole(1, 4);
  return closedBody(kit, "cabinet", {depth, width, height}, columns, rows);
}

Furniture bookshelf(FurnitureKit& kit)
{
  Furniture shelf{objectOf("bookshelf"), {}};
  const double depth = kit.between(0.25, 0.38), width = kit.between(0.6, 1.2);
  const double height = kit.chance(0.3) ? kit.between(0.9, 1.3) : kit.between(1.5, 2.05);
  const std::size_t wood = kit.chance(0.6) ? kit.wood() : kit.lacquer();
  const double board = 0.025;
  for (const double side : {-1, 1})
    addBox(shelf.object, {0, side * (width - board) / 2, height / 2}, {depth, board, height}, wood);
  if (kit.chance(0.7))
    addBox(shelf.object, {-depth / 2 + 0.005, 0, height / 2}, {0.01, width, height}, wood);
  const int levels = static_cast<int>(height / kit.between(0.32, 0.42));
  for (int i = 0; i <= levels; ++i)
  {
    const double z = 0.05 + i * (height - 0.05 - board) / levels;
    addBox(shelf.object, {0, 0, z + board / 2}, {depth, width - 2 * board, board}, wood);
    const double room = i < levels ? (height - 0.05 - board) / levels - board : kAbove;
    if (i < levels || height < kHighestTop)
      shelf.shelves.push_back({
          {        0.01,                        0},
          {0.46 * depth, width / 2 - board - 0.01},
          z + board, room
      });
  }
  std::rotate(shelf.shelves.begin(), shelf.shelves.end() - 1, shelf.shelves.end());
  return shelf;
}

Furniture nightstand(FurnitureKit& kit)
{
  const Eigen::Vector3d size{
      kit.between(0.33, 0.45), kit.between(0.36, 0.52), kit.between(0.42, 0.62)};
  return closedBody(kit, "nightstand", size, 1, kit.whole(1, 3));
}

Furniture screenStand(FurnitureKit& kit)
{
  const Eigen::Vector3d size{
      kit.between(0.36, 0.48), kit.between(1.1, 1.8), kit.between(0.35, 0.6)};
  const int rows = kit.whole(1, 2), columns = kit.whole(2, 4);
  return closedBody(kit, kit.chance(0.5) ? "cabinet" : "", size, columns, rows);
}

Furniture refrigerator(FurnitureKit& kit)
{
  Furniture piece{objectOf("refrigerator"), {}};
  const Eigen::Vector3d size{
      kit.between(0.56, 0.68), kit.between(0.54, 0.7),
      kit.chance(0.2) ? kit.between(0.82, 0.9) : kit.between(1.45, 1.95)};
  const std::size_t steel = kit.chance(0.5) ? kit.metal() : kit.lacquer();
  addBox(piece.object, {0, 0, size.z() / 2}, size, steel);
  const double parting = size.z() > 1 ? kit.between(0.35, 0.7) * size.z() : size.z();
  for (const auto& [low, high] : {
           std::pair{   0.06,  parting},
           {parting, size.z()}
  })
  {
    if (high - low < 0.1) continue;
    const double middle = (low + high) / 2;
    addBox(
        piece.object, {size.x() / 2 + 0.02, 0, middle}, {0.04, size.y(), high - low - 0.01}, steel);
    addBox(
        piece.object, {size.x() / 2 + 0.055, 0.4 * size.y(), middle},
        {0.03, 0.025, 0.5 * (high - low)}, kit.metal());
  }
  if (size.z() < kHighestTop)
    piece.shelves.push_back({
        {0, 0},
        0.46 * size.head<2>(), size.z(), kAbove
    });
  return piece;
}

Furniture oven(FurnitureKit& kit)
{
  Furniture piece{objectOf("oven"), {}};
  const Eigen::Vector3d size{0.58, kit.between(0.5, 0.62), kit.between(0.84, 0.91)};
  const std::size_t body = kit.chance(0.5) ? kit.lacquer() : kit.metal();
  addBox(piece.object, {0, 0, size.z() / 2}, size, body);
  addBox(
      piece.object, {size.x() / 2 + 0.01, 0, 0.42 * size.z()},
      {0.02, size.y() - 0.06, 0.5 * size.z()}, kit.screen());
  addBox(
      piece.object, {size.x() / 2 + 0.03, 0, 0.75 * size.z()}, {0.03, 0.8 * size.y(), 0.02},
      kit.metal());
  piece.shelves.push_back({
      {0, 0},
      0.44 * size.head<2>(), size.z(), kAbove
  });
  return piece;
}

Furniture kitchenBlock(FurnitureKit& kit)
{
  const double width = kit.between(0.6, 1.8);
  const int columns = static_cast<int>(std::lround(width / 0.55));
  const int rows = kit.whole(1, 3);
  Furniture block =
      closedBody(kit, "cabinet", {0.58, width, kit.between(0.83, 0.87)}, columns, rows);
  const double top = block.shelves.front().z;
  addBox(block.object, {0.01, 0, top + 0.02}, {0.62, width, 0.04}, kit.wood());
  block.shelves.front().z = top + 0.04;
  return block;
}

Furniture wallCupboard(FurnitureKit& kit)
{
  const double width = kit.between(0.6, 1.2);
  Furniture cupboard{objectOf("cabinet"), {}};
  const Eigen::Vector3d size{kit.between(0.3, 0.36), width, kit.between(0.55, 0.75)};
  addBox(cupboard.object, {0, 0, size.z() / 2}, size, kit.lacquer());
  const std::size_t grip = kit.metal(), front = kit.lacquer();
  addFronts(cupboard.object, size, 0, static_cast<int>(std::lround(width / 0.5)), 1, front, grip);
  return cupboard;
}

}  // namespace quadmap::simulator
