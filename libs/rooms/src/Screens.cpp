#include "Screens.h"

#include <cmath>

namespace quadmap::simulator
{
namespace
{
/** A panel and its screen. \param z Height of its lower edge [m]. */
void addPanel(
    SceneObject& object, FurnitureKit& kit, const Eigen::Vector3d& size, double z, double rim)
{
  const double middle = z + size.z() / 2;
  addBox(object, {0, 0, middle}, size, kit.chance(0.8) ? kit.darkPlastic() : kit.metal());
  addBox(
      object, {size.x() / 2 + 0.001, 0, middle}, {0.003, size.y() - 2 * rim, size.z() - 2 * rim},
      kit.screen());
  if (kit.chance(0.5))  // the electronics behind it
    addBox(
        object, {-size.x() / 2 - 0.012, 0, z + 0.4 * size.z()},
        {0.024, 0.5 * size.y(), 0.5 * size.z()}, kit.darkPlastic());
}

Eigen::Vector3d panelOf(FurnitureKit& kit, double minWidth, double maxWidth)
{
  const double width = kit.between(minWidth, maxWidth);
  return {kit.between(0.025, 0.055), width, width * kit.between(0.54, 0.62)};
}

}  // namespace

StandingScreen television(FurnitureKit& kit)
{
  SceneObject tv = objectOf("tv");
  const Eigen::Vector3d size = panelOf(kit, 0.7, 1.35);
  const double lift = kit.between(0.04, 0.1), depth = kit.between(0.18, 0.28);
  addPanel(tv, kit, size, lift, kit.between(0.01, 0.035));
  const std::size_t panelParts = tv.parts.size();
  const std::size_t plastic = kit.darkPlastic();
  if (kit.chance(0.5))
    for (const double side : {-1, 1})
    {
      const double y = side * 0.36 * size.y();
      addBox(tv, {0, y, lift / 2}, {0.03, 0.03, lift}, plastic);
      addBox(tv, {0, y, 0.01}, {depth, 0.03, 0.02}, plastic);
    }
  else
  {
    addBox(tv, {0, 0, lift / 2}, {0.05, 0.2, lift}, plastic);
    addBox(tv, {0, 0, 0.01}, {depth, kit.between(0.35, 0.55), 0.02}, plastic);
  }
  return {tv, panelParts};
}

SceneObject wallTelevision(FurnitureKit& kit)
{
  SceneObject tv = objectOf("tv");
  const double rim = kit.between(0.01, 0.03);
  addPanel(tv, kit, panelOf(kit, 0.8, 1.45), 0, rim);
  return tv;
}

StandingScreen monitor(FurnitureKit& kit)
{
  SceneObject monitor = objectOf(kit.chance(0.5) ? "tv" : "monitor");
  const Eigen::Vector3d size = panelOf(kit, 0.45, 0.72);
  const double lift = kit.between(0.06, 0.2);
  addPanel(monitor, kit, size, lift, kit.between(0.008, 0.025));
  const std::size_t panelParts = monitor.parts.size();
  const std::size_t plastic = kit.darkPlastic();
  const double back = size.x() / 2 + 0.04;
  addBox(monitor, {-back, 0, (lift + 0.15) / 2}, {0.03, 0.06, lift + 0.15}, plastic);
  addBox(
      monitor, {-0.03, 0, 0.01}, {kit.between(0.16, 0.24), kit.between(0.2, 0.3), 0.02}, plastic);
  return {monitor, panelParts};
}

SceneObject laptop(FurnitureKit& kit)
{
  SceneObject laptop = objectOf("laptop");
  const double width = kit.between(0.29, 0.38), depth = 0.68 * width, lean = kit.between(0.1, 0.5);
  const std::size_t shell = kit.chance(0.5) ? kit.metal() : kit.darkPlastic();
  addBox(laptop, {0, 0, 0.01}, {depth, width, 0.02}, shell);
  const double length = 0.65 * width;
  const Eigen::Vector3d hinge(-depth / 2, 0, 0.018);
  const Eigen::Vector3d along(-std::sin(lean), 0, std::cos(lean));
  addBox(laptop, hinge + 0.5 * length * along, {0.01, width, length}, shell, 0, -lean);
  addBox(
      laptop, hinge + 0.5 * length * along + Eigen::Vector3d(0.007, 0, 0),
      {0.003, width - 0.02, length - 0.03}, kit.screen(), 0, -lean);
  return laptop;
}

}  // namespace quadmap::simulator
