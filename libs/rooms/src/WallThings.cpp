#include "WallThings.h"

#include <cmath>

namespace quadmap::simulator
{
SceneObject doorFrame(FurnitureKit& kit, double width, double height)
{
  SceneObject frame = objectOf("");
  const std::size_t paint = kit.lacquer();
  for (const double side : {-1, 1})
    addBox(
        frame, {0.01, side * (width / 2 + 0.045), (height + 0.08) / 2}, {0.02, 0.08, height + 0.08},
        paint);
  addBox(frame, {0.01, 0, height + 0.045}, {0.02, width, 0.07}, paint);
  // What is seen of the next room through the open door: a dark patch of the wall.
  addBox(frame, {0.002, 0, height / 2}, {0.004, width, height}, kit.darkPlastic());
  return frame;
}

SceneObject doorLeaf(FurnitureKit& kit, double width, double height, double opening)
{
  SceneObject leaf = objectOf("door");
  const std::size_t paint = kit.chance(0.6) ? kit.lacquer() : kit.wood();
  const double thick = 0.04;
  addBox(leaf, {0, 0, height / 2}, {thick, width, height - 0.01}, paint);
  const bool closed = opening == 0;
  for (const double side : {-1, 1})
    if (side > 0 || !closed)
      addBox(
          leaf, {side * (thick / 2 + 0.025), width / 2 - 0.08, 1.03}, {0.05, 0.12, 0.02},
          kit.metal());
  const Eigen::Vector2d middle =
      0.5 * width * Eigen::Vector2d(std::sin(opening), std::cos(opening));
  leaf.T_world_obj = {(closed ? 0.03 : 0.075) + middle.x(), middle.y(), 0, -opening, 0, 0};
  return leaf;
}

SceneObject window(FurnitureKit& kit)
{
  SceneObject window = objectOf(kit.chance(0.5) ? "window" : "");
  const double w = kit.between(0.8, 1.6), h = kit.between(0.9, 1.3), d = 0.06;
  const std::size_t paint = kit.lacquer();
  for (const double side : {-1, 1})
  {
    addBox(window, {d / 2, side * (w / 2 - 0.03), h / 2}, {d, 0.06, h}, paint);
    addBox(window, {d / 2, 0, h / 2 + side * (h / 2 - 0.03)}, {d, w, 0.06}, paint);
  }
  if (w > 1.1) addBox(window, {d / 2, 0, h / 2}, {d, 0.08, h}, paint);
  addBox(window, {0.01, 0, h / 2}, {0.01, w, h}, kit.glass());
  return window;
}

SceneObject picture(FurnitureKit& kit)
{
  SceneObject picture = objectOf(kit.chance(0.6) ? "picture" : "");
  const double w = kit.between(0.3, 1.1), h = w * kit.between(0.65, 1.4),
               d = kit.between(0.015, 0.035);
  addBox(picture, {d / 2, 0, h / 2}, {d, w, h}, kit.wood());
  addBox(picture, {d / 2 + 0.003, 0, h / 2}, {d, w - 0.06, h - 0.06}, kit.printed());
  return picture;
}

SceneObject wallClock(FurnitureKit& kit)
{
  SceneObject clock = objectOf("clock");
  const double size = kit.between(0.22, 0.36), d = kit.between(0.03, 0.06);
  addBox(clock, {d / 2, 0, size / 2}, {d, size, size}, kit.darkPlastic());
  addBox(clock, {d / 2 + 0.002, 0, size / 2}, {d, size - 0.04, size - 0.04}, kit.paper());
  return clock;
}

SceneObject radiator(FurnitureKit& kit)
{
  SceneObject radiator = objectOf("");
  const double width = kit.between(0.6, 1.4);
  const std::size_t paint = kit.lacquer();
  const int ribs = static_cast<int>(width / 0.08);
  addBox(radiator, {0.06, 0, 0.4}, {0.02, width, 0.5}, paint);
  for (int i = 0; i < ribs; ++i)
    addBox(radiator, {0.06, width * ((i + 0.5) / ribs - 0.5), 0.4}, {0.08, 0.04, 0.54}, paint);
  return radiator;
}

HangingLamp hangingLamp(FurnitureKit& kit, double length)
{
  HangingLamp lamp{objectOf("lamp", false), objectOf("")};
  const double size = kit.between(0.28, 0.5), shade = kit.between(0.16, 0.28);
  const double cord = length - shade;
  addCylinder(lamp.cord, {0, 0, -cord / 2}, {0.012, 0.012, cord}, kit.darkPlastic());
  const Eigen::Vector3d at(0, 0, shade / 2 - length), full(size, size, shade);
  if (kit.chance(0.5))
    addEllipsoid(lamp.shade, at, full, kit.paper());
  else
    addCylinder(lamp.shade, at, full, kit.cover());
  return lamp;
}

SceneObject person(FurnitureKit& kit)
{
  SceneObject person = objectOf("person", false);
  const double s = kit.between(0.9, 1.08);  // of a person 1.75 m tall
  const std::size_t trousers = kit.cloth(), shirt = kit.cloth(), skin = kit.skin();
  for (const double y : {-0.1, 0.1})
  {
    addCylinder(
        person, s * Eigen::Vector3d(0, y, 0.43), s * Eigen::Vector3d(0.15, 0.15, 0.86), trousers);
    addBox(
        person, s * Eigen::Vector3d(0.05, y, 0.035), s * Eigen::Vector3d(0.26, 0.1, 0.07),
        trousers);
    addCylinder(
        person, s * Eigen::Vector3d(0.02, 2.4 * y, 1.1), s * Eigen::Vector3d(0.1, 0.1, 0.62),
        shirt);
  }
  addEllipsoid(
      person, s * Eigen::Vector3d(0, 0, 1.15), s * Eigen::Vector3d(0.26, 0.44, 0.76), shirt);
  addCylinder(person, s * Eigen::Vector3d(0, 0, 1.5), s * Eigen::Vector3d(0.11, 0.11, 0.14), skin);
  addEllipsoid(
      person, s * Eigen::Vector3d(0.02, 0, 1.63), s * Eigen::Vector3d(0.2, 0.16, 0.24), skin);
  return person;
}

}  // namespace quadmap::simulator
