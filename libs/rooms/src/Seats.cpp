#include "Seats.h"

#include <cmath>

namespace quadmap::simulator
{
namespace
{
/** The measures of a chair with four legs [m]. */
struct ChairFrame
{
  double depth, width, seat, height, leg;
  double lean;  // of the back [rad]
};

/** The back above the seat, which leans backwards about the seat's rear edge. */
void addBack(
    SceneObject& chair, FurnitureKit& kit, const ChairFrame& f, std::size_t wood, std::size_t cloth)
{
  const double length = (f.height - f.seat) / std::cos(f.lean);
  const auto behind = [&](double share)  // centre line of the back at a share of its length
  {
    const double s = share * length;
    return Eigen::Vector3d(
        -f.depth / 2 + f.leg / 2 - s * std::sin(f.lean), 0, f.seat + s * std::cos(f.lean));
  };
  const auto board = [&](double from, double to, double y, const Eigen::Vector2d& section, auto mat)
  {
    const Eigen::Vector3d at = behind(0.5 * (from + to)) + Eigen::Vector3d(0, y, 0);
    addBox(chair, at, {section.x(), section.y(), (to - from) * length}, mat, 0, -f.lean);
  };
  for (const double y : {-1, 1}) board(0, 1, y * (f.width - f.leg) / 2, {f.leg, f.leg}, wood);
  const double inner = f.width - 2 * f.leg;
  const std::size_t style = kit.pick(4);
  if (style == 0) board(kit.between(0.2, 0.45), 0.97, 0, {0.02, inner}, wood);
  if (style == 1) board(0.12, 1, 0, {kit.between(0.04, 0.07), inner}, cloth);
  if (style == 2)  // one looks through
  {
    const int slats = kit.whole(3, 5);
    board(0.9, 1, 0, {0.02, inner}, wood);
    for (int i = 0; i < slats; ++i)
      board(0.05, 0.9, inner * ((i + 0.5) / slats - 0.5), {0.015, 0.025}, wood);
  }
  if (style == 3)
    for (int i = kit.whole(0, 1); i < 3; ++i)
      board(0.3 + 0.25 * i, 0.42 + 0.25 * i, 0, {0.02, inner}, wood);
}

/** What couch and armchair have in common [m]. */
struct CouchFrame
{
  double depth, width, seat, height, arm, back;
  bool onLegs;
};

SceneObject couchOf(FurnitureKit& kit, const std::string& label, const CouchFrame& f)
{
  SceneObject couch = objectOf(label);
  const std::size_t cloth = kit.cloth(), cushions = kit.chance(0.4) ? kit.cloth() : cloth;
  const double bottom = f.onLegs ? kit.between(0.08, 0.16) : 0.0;
  if (f.onLegs)
    addLegs(couch, {f.depth / 2 - 0.06, f.width / 2 - 0.06}, bottom, 0.05, true, kit.wood());
  const double base = f.seat - 0.12;
  addBox(couch, {0, 0, (bottom + base) / 2}, {f.depth, f.width, base - bottom}, cloth);
  addBox(
      couch, {-f.depth / 2 + f.back / 2, 0, (base + f.height) / 2},
      {f.back, f.width, f.height - base}, cloth);
  const double armHeight = f.seat + kit.between(0.05, 0.2);
  if (f.arm > 0)
    for (const double y : {-1, 1})
      addBox(
          couch, {f.back / 2, y * (f.width - f.arm) / 2, (base + armHeight) / 2},
          {f.depth - f.back, f.arm, armHeight - base}, cloth);
  const double inner = f.width - 2 * f.arm;
  const int seats = std::max(1, static_cast<int>(std::lround(inner / 0.7)));
  const double overhang = kit.between(0, 0.03);
  for (int i = 0; i < seats; ++i)
    addBox(
        couch, {f.back / 2 + overhang / 2, inner * ((i + 0.5) / seats - 0.5), f.seat - 0.06},
        {f.depth - f.back + overhang, inner / seats - 0.01, 0.12}, cushions);
  return couch;
}

}  // namespace

SceneObject diningChair(FurnitureKit& kit)
{
  SceneObject chair = objectOf("chair");
  ChairFrame f{};
  f.depth = kit.between(0.38, 0.5);
  f.width = kit.between(0.38, 0.52);
  f.seat = kit.between(0.43, 0.48);
  f.height = kit.between(0.76, 1.05);
  f.leg = kit.between(0.025, 0.05);
  f.lean = kit.between(0, 0.17);
  const bool round = kit.chance(0.4);
  const std::size_t wood = kit.chance(0.75) ? kit.wood() : kit.metal(), cloth = kit.cloth();
  const double thick = kit.between(0.02, 0.09);
  addBox(chair, {0, 0, f.seat - thick / 2}, {f.depth, f.width, thick}, thick > 0.05 ? cloth : wood);
  addLegs(
      chair, {(f.depth - f.leg) / 2, (f.width - f.leg) / 2}, f.seat - thick, f.leg, round, wood);
  if (thick <= 0.05 && kit.chance(0.3))
    addEllipsoid(chair, {0.01, 0, f.seat + 0.01}, {0.8 * f.depth, 0.8 * f.width, 0.06}, cloth);
  addBack(chair, kit, f, wood, cloth);
  if (kit.chance(0.2))
    for (const double y : {-1, 1})
    {
      const double z = f.seat + kit.between(0.18, 0.2);
      addBox(chair, {0, y * (f.width / 2 - 0.02), z}, {f.depth, 0.04, 0.03}, wood);
      addBox(
          chair, {f.depth / 2 - 0.02, y * (f.width / 2 - 0.02), (z + f.seat) / 2},
          {0.03, 0.03, z - f.seat}, wood);
    }
  return chair;
}

SceneObject officeChair(FurnitureKit& kit)
{
  SceneObject chair = objectOf("chair");
  const std::size_t cloth = kit.cloth(), plastic = kit.darkPlastic();
  const double seat = kit.between(0.43, 0.54), width = kit.between(0.44, 0.52);
  const double depth = kit.between(0.44, 0.5), back = kit.between(0.4, 0.68);
  const double radius = kit.between(0.28, 0.34), turn = kit.between(0, 1.2);
  addBox(chair, {0.02, 0, seat - 0.04}, {depth, width, 0.08}, cloth);
  const double lean = kit.between(0.05, 0.2), gap = kit.between(0, 0.12);
  const double middle = gap + back / 2;
  addBox(
      chair, {-depth / 2 + 0.03 - middle * std::sin(lean), 0, seat + middle * std::cos(lean)},
      {0.06, width - 0.04, back}, cloth, 0, -lean);
  if (gap > 0.02)
    addBox(chair, {-depth / 2 + 0.02, 0, seat + gap / 2}, {0.03, 0.06, gap + 0.1}, plastic);
  addCylinder(chair, {0, 0, seat / 2}, {0.06, 0.06, seat - 0.16}, plastic);
  for (int i = 0; i < 5; ++i)
  {
    const double a = turn + 2 * M_PI * i / 5;
    const Eigen::Vector3d along(std::cos(a), std::sin(a), 0);
    addBox(
        chair, Eigen::Vector3d(0, 0, 0.07) + 0.5 * radius * along, {radius, 0.045, 0.04}, plastic,
        a);
    addEllipsoid(
        chair, Eigen::Vector3d(0, 0, 0.025) + (radius - 0.03) * along, {0.05, 0.05, 0.05}, plastic);
  }
  if (kit.chance(0.6))
    for (const double y : {-1, 1})
    {
      const double z = seat + kit.between(0.18, 0.22);
      addBox(chair, {0, y * (width / 2 + 0.03), z}, {0.26, 0.05, 0.03}, plastic);
      addBox(
          chair, {0, y * (width / 2 + 0.02), (z + seat) / 2 - 0.04}, {0.05, 0.03, z - seat + 0.06},
          plastic);
    }
  return chair;
}

SceneObject stool(FurnitureKit& kit)
{
  SceneObject stool = objectOf("stool", false);
  const double height = kit.between(0.42, 0.68), size = kit.between(0.3, 0.42);
  const std::size_t wood = kit.wood();
  addCylinder(
      stool, {0, 0, height - 0.025}, {size, size, 0.05}, kit.chance(0.5) ? wood : kit.cloth());
  addLegs(stool, {0.3 * size, 0.3 * size}, height - 0.05, 0.035, true, wood);
  return stool;
}

SceneObject couch(FurnitureKit& kit)
{
  CouchFrame f{};
  f.depth = kit.between(0.78, 1.0);
  f.width = kit.between(1.4, 2.3);
  f.seat = kit.between(0.38, 0.46);
  f.height = kit.between(0.68, 0.95);
  f.arm = kit.chance(0.8) ? kit.between(0.1, 0.25) : 0;
  f.back = kit.between(0.16, 0.28);
  f.onLegs = kit.chance(0.5);
  SceneObject couch = couchOf(kit, "couch", f);
  if (f.width > 1.8 && kit.chance(0.25))  // the seat at one end is long
  {
    const double length = kit.between(0.4, 0.6), side = kit.chance(0.5) ? 1 : -1;
    const double width = kit.between(0.65, 0.8);
    addBox(
        couch, {(f.depth + length) / 2, side * (f.width - width) / 2, f.seat / 2},
        {length, width, f.seat}, couch.parts.back().material);
  }
  return couch;
}

SceneObject armchair(FurnitureKit& kit)
{
  CouchFrame f{};
  f.depth = kit.between(0.68, 0.88);
  f.width = kit.between(0.7, 0.95);
  f.seat = kit.between(0.38, 0.45);
  f.height = kit.between(0.75, 1.05);
  f.arm = kit.between(0.08, 0.18);
  f.back = kit.between(0.12, 0.2);
  f.onLegs = kit.chance(0.6);
  return couchOf(kit, "armchair", f);
}

SceneObject bed(FurnitureKit& kit)
{
  SceneObject bed = objectOf("bed");
  const double width = kit.chance(0.4) ? kit.between(0.9, 1.1) : kit.between(1.4, 1.8);
  const double length = kit.between(1.98, 2.12), frame = kit.between(0.24, 0.36);
  const double top = frame + kit.between(0.12, 0.22), bottom = kit.chance(0.5) ? 0.0 : 0.14;
  const std::size_t wood = kit.chance(0.7) ? kit.wood() : kit.cloth(), linen = kit.lacquer();
  addBox(bed, {0, 0, (bottom + frame) / 2}, {length, width, frame - bottom}, wood);
  if (bottom > 0) addLegs(bed, {length / 2 - 0.06, width / 2 - 0.06}, bottom, 0.06, false, wood);
  addBox(bed, {0, 0, (frame + top) / 2}, {length - 0.06, width - 0.04, top - frame}, linen);
  const double covered = kit.between(0.55, 0.75) * length;
  addBox(bed, {(length - covered) / 2 - 0.02, 0, top + 0.02}, {covered, width, 0.06}, kit.cloth());
  if (kit.chance(0.75))
    addBox(bed, {-length / 2 - 0.03, 0, kit.between(0.38, 0.55)}, {0.06, width, 0.76}, wood);
  const int pillows = width > 1.3 ? 2 : 1;
  for (int i = 0; i < pillows; ++i)
    addEllipsoid(
        bed, {-length / 2 + 0.28, width * ((i + 0.5) / pillows - 0.5), top + 0.05},
        {0.42, 0.85 * width / pillows, 0.16}, linen);
  return bed;
}

}  // namespace quadmap::simulator
