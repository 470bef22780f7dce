#include "SmallThings.h"

#include <cmath>

namespace quadmap::simulator
{
namespace
{
SceneObject vase(FurnitureKit& kit)
{
  SceneObject vase = objectOf("vase", false);
  const double width = kit.between(0.1, 0.2), height = kit.between(0.2, 0.36);
  const std::size_t glaze = kit.ceramic();
  addCylinder(vase, {0, 0, 0.02}, {0.6 * width, 0.6 * width, 0.04}, glaze);
  addEllipsoid(vase, {0, 0, 0.02 + 0.35 * height}, {width, width, 0.7 * height}, glaze);
  addCylinder(vase, {0, 0, 0.8 * height}, {0.4 * width, 0.4 * width, 0.4 * height}, glaze);
  return vase;
}

SceneObject fruit(FurnitureKit& kit)
{
  SceneObject fruit = objectOf(kit.chance(0.5) ? "apple" : "orange", false);
  const double size = kit.between(0.065, 0.09);
  addEllipsoid(fruit, {0, 0, size / 2}, {size, size, size}, kit.cover());
  return fruit;
}

SceneObject teddyBear(FurnitureKit& kit)
{
  SceneObject bear = objectOf("teddy bear", false);
  const double s = kit.between(0.8, 1.3);
  const std::size_t fur = kit.cloth();
  addEllipsoid(bear, s * Eigen::Vector3d(0, 0, 0.13), s * Eigen::Vector3d(0.17, 0.2, 0.26), fur);
  addEllipsoid(
      bear, s * Eigen::Vector3d(0.02, 0, 0.29), s * Eigen::Vector3d(0.15, 0.15, 0.14), fur);
  for (const double y : {-1, 1})
  {
    addEllipsoid(
        bear, s * Eigen::Vector3d(0.12, 0.07 * y, 0.045), s * Eigen::Vector3d(0.18, 0.08, 0.09),
        fur);
    addEllipsoid(
        bear, s * Eigen::Vector3d(0.02, 0.06 * y, 0.355), s * Eigen::Vector3d(0.03, 0.05, 0.05),
        fur);
  }
  return bear;
}

SceneObject backpack(FurnitureKit& kit)
{
  SceneObject bag = objectOf("backpack");
  const double w = kit.between(0.28, 0.36), h = kit.between(0.4, 0.52);
  const std::size_t cloth = kit.cloth();
  addEllipsoid(bag, {0, 0, h / 2}, {0.26, 1.1 * w, h}, cloth);
  addBox(bag, {0, 0, 0.4 * h}, {0.2, w, 0.75 * h}, cloth);
  addBox(bag, {0.12, 0, 0.3 * h}, {0.06, 0.7 * w, 0.4 * h}, cloth);
  return bag;
}

SceneObject suitcase(FurnitureKit& kit)
{
  SceneObject suitcase = objectOf("suitcase");
  const double w = kit.between(0.36, 0.5), h = kit.between(0.5, 0.75), d = kit.between(0.2, 0.3);
  const std::size_t plastic = kit.darkPlastic();
  addBox(suitcase, {0, 0, 0.04 + h / 2}, {d, w, h}, kit.cover());
  addLegs(suitcase, {d / 2 - 0.04, w / 2 - 0.05}, 0.04, 0.04, true, plastic);
  if (kit.chance(0.5))
    for (const double y : {-1, 1})
      addBox(suitcase, {-d / 2 + 0.02, 0.08 * y, 0.14 + h}, {0.015, 0.015, 0.2}, plastic);
  addBox(suitcase, {-d / 2 + 0.02, 0, h + 0.06}, {0.03, 0.2, 0.03}, plastic);
  return suitcase;
}

SceneObject trashCan(FurnitureKit& kit)
{
  SceneObject can = objectOf("trash can", false);
  const double size = kit.between(0.22, 0.34), height = kit.between(0.28, 0.5);
  addCylinder(
      can, {0, 0, height / 2}, {size, size, height},
      kit.chance(0.5) ? kit.metal() : kit.darkPlastic());
  return can;
}

SceneObject carton(FurnitureKit& kit)
{
  SceneObject box = objectOf("box");
  const Eigen::Vector3d size{
      kit.between(0.22, 0.4), kit.between(0.3, 0.55), kit.between(0.18, 0.4)};
  addBox(box, {0, 0, size.z() / 2}, size, kit.cover());
  return box;
}

SceneObject ball(FurnitureKit& kit)
{
  SceneObject ball = objectOf("sports ball", false);
  const double size = kit.between(0.17, 0.24);
  addEllipsoid(ball, {0, 0, size / 2}, {size, size, size}, kit.cover());
  return ball;
}

using Maker = SceneObject (*)(FurnitureKit&);
constexpr Maker kSmall[] = {cup,       cup,  bottle, bowl,       lyingBook,
                            lyingBook, vase, fruit,  tablePlant, remote};
constexpr Maker kFloor[] = {suitcase, carton, carton, backpack, trashCan, teddyBear, ball};

}  // namespace

std::size_t smallKinds() { return std::size(kSmall); }

SceneObject smallThing(FurnitureKit& kit, std::size_t kind) { return kSmall[kind](kit); }

SceneObject floorThing(FurnitureKit& kit) { return kFloor[kit.pick(std::size(kFloor))](kit); }

SceneObject cup(FurnitureKit& kit)
{
  SceneObject cup = objectOf("cup", false);
  const double width = kit.between(0.07, 0.1), height = kit.between(0.07, 0.13);
  const std::size_t glaze = kit.ceramic();
  addCylinder(cup, {0, 0, height / 2}, {width, width, height}, glaze);
  if (kit.chance(0.7))
    addBox(cup, {0, width / 2 + 0.012, height / 2}, {0.012, 0.025, 0.6 * height}, glaze);
  return cup;
}

SceneObject bottle(FurnitureKit& kit)
{
  SceneObject bottle = objectOf("bottle", false);
  const double width = kit.between(0.06, 0.1), height = kit.between(0.2, 0.33);
  const std::size_t body = kit.cover();
  addCylinder(bottle, {0, 0, 0.33 * height}, {width, width, 0.66 * height}, body);
  addCylinder(bottle, {0, 0, 0.8 * height}, {0.4 * width, 0.4 * width, 0.4 * height}, body);
  return bottle;
}

SceneObject bowl(FurnitureKit& kit)
{
  SceneObject bowl = objectOf("bowl", false);
  const double width = kit.between(0.13, 0.26), height = kit.between(0.06, 0.1);
  const std::size_t glaze = kit.ceramic();
  addCylinder(bowl, {0, 0, 0.15 * height}, {0.5 * width, 0.5 * width, 0.3 * height}, glaze);
  addCylinder(bowl, {0, 0, 0.65 * height}, {width, width, 0.7 * height}, glaze);
  return bowl;
}

SceneObject lyingBook(FurnitureKit& kit)
{
  SceneObject book = objectOf("book");
  const double w = kit.between(0.13, 0.23), l = kit.between(1.25, 1.45) * w,
               h = kit.between(0.015, 0.06);
  const std::size_t cover = kit.cover();
  addBox(book, {0, 0, h / 2}, {w, l, h}, cover);
  addBox(book, {0.004, 0, h / 2}, {w, l - 0.01, 0.7 * h}, kit.paper());
  return book;
}

SceneObject standingBook(FurnitureKit& kit)
{
  SceneObject book = objectOf("book");
  const double d = kit.between(0.13, 0.2), h = kit.between(0.19, 0.29);
  const std::size_t cover = kit.cover();
  addBox(book, {0, 0, h / 2}, {d, kit.between(0.02, 0.06), h}, cover);
  return book;
}

SceneObject keyboard(FurnitureKit& kit)
{
  SceneObject keyboard = objectOf("keyboard");
  const double h = kit.between(0.015, 0.03);
  const std::size_t body = kit.chance(0.6) ? kit.darkPlastic() : kit.lacquer();
  addBox(keyboard, {0, 0, h / 2}, {kit.between(0.12, 0.17), kit.between(0.35, 0.47), h}, body);
  return keyboard;
}

SceneObject computerMouse(FurnitureKit& kit)
{
  SceneObject mouse = objectOf("mouse", false);
  addEllipsoid(mouse, {0, 0, 0.018}, {0.11, 0.06, 0.036}, kit.darkPlastic());
  return mouse;
}

SceneObject remote(FurnitureKit& kit)
{
  SceneObject remote = objectOf("remote");
  const std::size_t plastic = kit.darkPlastic();
  addBox(remote, {0, 0, 0.012}, {kit.between(0.15, 0.21), 0.05, 0.024}, plastic);
  return remote;
}

SceneObject tableLamp(FurnitureKit& kit)
{
  SceneObject lamp = objectOf("lamp", false);
  const double height = kit.between(0.32, 0.52), shade = kit.between(0.18, 0.32);
  const std::size_t metal = kit.metal();
  addCylinder(lamp, {0, 0, 0.01}, {0.14, 0.14, 0.02}, metal);
  addCylinder(lamp, {0, 0, height / 2}, {0.025, 0.025, height}, metal);
  addCylinder(lamp, {0, 0, 0.78 * height}, {shade, shade, 0.44 * height}, kit.paper());
  return lamp;
}

SceneObject tablePlant(FurnitureKit& kit)
{
  SceneObject plant = objectOf("potted plant", false);
  const double pot = kit.between(0.11, 0.18), crown = kit.between(0.18, 0.32);
  addCylinder(plant, {0, 0, 0.45 * pot}, {pot, pot, 0.9 * pot}, kit.ceramic());
  const std::size_t leaves = kit.leaves();
  for (int i = kit.whole(2, 4); i > 0; --i)
  {
    const Eigen::Vector3d size =
        crown * Eigen::Vector3d{kit.between(0.6, 1), kit.between(0.6, 1), kit.between(0.5, 0.9)};
    addEllipsoid(
        plant,
        {kit.gaussian(0.03), kit.gaussian(0.03), 0.85 * pot + size.z() * kit.between(0.4, 0.7)},
        size, leaves);
  }
  return plant;
}

SceneObject kitchenMachine(FurnitureKit& kit)
{
  if (kit.chance(0.4))
  {
    SceneObject toaster = objectOf("toaster");
    const Eigen::Vector3d size{
        kit.between(0.15, 0.2), kit.between(0.26, 0.32), kit.between(0.17, 0.21)};
    addBox(toaster, {0, 0, size.z() / 2}, size, kit.chance(0.5) ? kit.metal() : kit.cover());
    return toaster;
  }
  SceneObject microwave = objectOf("microwave");
  const Eigen::Vector3d size{
      kit.between(0.32, 0.42), kit.between(0.44, 0.54), kit.between(0.26, 0.32)};
  addBox(
      microwave, {0, 0, size.z() / 2}, size, kit.chance(0.6) ? kit.lacquer() : kit.darkPlastic());
  addBox(
      microwave, {size.x() / 2 + 0.005, 0.12 * size.y(), size.z() / 2},
      {0.01, 0.7 * size.y(), 0.85 * size.z()}, kit.screen());
  return microwave;
}

SceneObject printer(FurnitureKit& kit)
{
  SceneObject printer = objectOf("printer");
  const Eigen::Vector3d size{
      kit.between(0.32, 0.42), kit.between(0.4, 0.5), kit.between(0.18, 0.32)};
  addBox(printer, {0, 0, size.z() / 2}, size, kit.chance(0.5) ? kit.lacquer() : kit.darkPlastic());
  addBox(printer, {size.x() / 2 + 0.05, 0, 0.05}, {0.1, 0.6 * size.y(), 0.02}, kit.darkPlastic());
  return printer;
}

SceneObject computer(FurnitureKit& kit)
{
  SceneObject tower = objectOf("computer");
  const Eigen::Vector3d size{
      kit.between(0.36, 0.46), kit.between(0.17, 0.21), kit.between(0.36, 0.46)};
  addBox(tower, {0, 0, size.z() / 2}, size, kit.chance(0.7) ? kit.darkPlastic() : kit.metal());
  return tower;
}

SceneObject floorPlant(FurnitureKit& kit)
{
  SceneObject plant = objectOf("potted plant", false);
  const double pot = kit.between(0.24, 0.38), height = kit.between(0.8, 1.6);
  addCylinder(plant, {0, 0, 0.42 * pot}, {pot, pot, 0.85 * pot}, kit.ceramic());
  const std::size_t leaves = kit.leaves();
  addCylinder(plant, {0, 0, 0.4 * height}, {0.04, 0.04, 0.8 * height}, kit.wood());
  if (kit.chance(0.3))  // a fountain of narrow leaves, which a depth camera hardly sees
  {
    for (int i = 0; i < 14; ++i)
    {
      const double a = 2 * M_PI * i / 14, rise = kit.between(0.4, 1.2), l = kit.between(0.3, 0.5);
      const Eigen::Vector3d along(
          std::cos(a) * std::cos(rise), std::sin(a) * std::cos(rise), std::sin(rise));
      addEllipsoid(
          plant, Eigen::Vector3d(0, 0, 0.7 * height) + 0.5 * l * along, {l, 0.05, 0.01}, leaves, a,
          -rise);
    }
    return plant;
  }
  for (int i = kit.whole(3, 6); i > 0; --i)
  {
    const Eigen::Vector3d size{
        kit.between(0.25, 0.55), kit.between(0.25, 0.55), kit.between(0.25, 0.5)};
    addEllipsoid(
        plant, {kit.gaussian(0.08), kit.gaussian(0.08), height * kit.between(0.55, 0.95)}, size,
        leaves);
  }
  return plant;
}

}  // namespace quadmap::simulator
