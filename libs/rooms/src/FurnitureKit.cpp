#include "FurnitureKit.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

namespace quadmap::simulator
{
std::size_t FurnitureKit::add(Material material)
{
  material.name = mrpt::format("material_%03zu", materials_.size() + 1);
  materials_.push_back(std::move(material));
  return materials_.size() - 1;
}

/** A colour each of whose channels is drawn between those of two others. */
Eigen::Vector3d FurnitureKit::colorBetween(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  const double blue = between(low[2], high[2]), green = between(low[1], high[1]);
  return {between(low[0], high[0]), green, blue};
}

/** A colour in whole steps about another one. */
Eigen::Vector3d FurnitureKit::near(const Eigen::Vector3d& color, double spread)
{
  const double shade = between(1 - spread, 1 + spread);
  Eigen::Vector3d result;
  for (int i = 0; i < 3; ++i)
    result[i] = std::clamp(std::round(color[i] * shade * between(0.92, 1.08)), 0.0, 255.0);
  return result;
}

std::size_t FurnitureKit::wood()
{
  const Eigen::Vector3d woods[] = {
      {165, 115,  65},
      {105,  70,  45},
      {205, 170, 120},
      { 70,  50,  40}
  };
  return add(
      {"", near(woods[pick(4)], 0.12), Pattern::Stripes, between(0.03, 0.08), between(0.1, 0.35)});
}

std::size_t FurnitureKit::lacquer()
{
  const Eigen::Vector3d paints[] = {
      {228, 228, 225},
      {200, 200, 195},
      {120, 125, 130},
      { 90, 110, 115}
  };
  const std::size_t paint = chance(0.6) ? 0 : pick(4);
  return add({"", near(paints[paint], 0.1), Pattern::Mottled, 0.2, between(0.02, 0.1)});
}

std::size_t FurnitureKit::cloth()
{
  const Eigen::Vector3d color = colorBetween({40, 40, 40}, {220, 220, 220});
  const Pattern pattern = chance(0.15) ? Pattern::Checker : Pattern::Mottled;
  return add({"", near(color, 0.05), pattern, between(0.03, 0.12), between(0.1, 0.3)});
}

std::size_t FurnitureKit::metal()
{
  return add({"", near({170, 173, 177}, 0.25), Pattern::Stripes, 0.08, between(0.05, 0.15)});
}

std::size_t FurnitureKit::darkPlastic()
{
  return add({"", near({38, 38, 42}, 0.3), Pattern::Mottled, 0.1, between(0.05, 0.2)});
}

std::size_t FurnitureKit::ceramic()
{
  const Eigen::Vector3d glazes[] = {
      {235, 232, 225},
      { 60,  95, 170},
      {180,  95,  60},
      { 70,  75,  80}
  };
  return add({"", near(glazes[pick(4)], 0.1), Pattern::Mottled, 0.03, between(0.1, 0.35)});
}

std::size_t FurnitureKit::leaves()
{
  return add({"", near({65, 120, 58}, 0.2), Pattern::Mottled, 0.05, between(0.3, 0.5)});
}

std::size_t FurnitureKit::paper()
{
  return add({"", near({238, 234, 220}, 0.04), Pattern::Mottled, 0.02, 0.15});
}

std::size_t FurnitureKit::cover()
{
  const Eigen::Vector3d color = colorBetween({30, 30, 30}, {230, 230, 230});
  return add({"", near(color, 0.05), Pattern::Mottled, between(0.02, 0.05), between(0.15, 0.4)});
}

std::size_t FurnitureKit::skin()
{
  return add({"", near({200, 160, 135}, 0.25), Pattern::Mottled, 0.05, 0.1});
}

std::size_t FurnitureKit::printed()
{
  const Eigen::Vector3d color = colorBetween({60, 60, 60}, {220, 220, 220});
  return add({"", near(color, 0.1), Pattern::Checker, between(0.08, 0.25), between(0.3, 0.7)});
}

std::size_t FurnitureKit::screen()
{
  constexpr double kMatt = 0.3;
  return add({"", near({20, 22, 27}, 0.2), Pattern::Mottled, 0.1, 0.1, chance(kMatt)});
}

std::size_t FurnitureKit::glass()
{
  return add({"", near({190, 205, 205}, 0.05), Pattern::Mottled, 0.1, 0.05, false});
}

std::size_t FurnitureKit::wallpaper()
{
  const Eigen::Vector3d color = colorBetween({170, 165, 150}, {235, 230, 225});
  return add({"", near(color, 0.02), Pattern::Mottled, between(0.1, 0.3), between(0.06, 0.22)});
}

std::size_t FurnitureKit::floor()
{
  if (chance(0.4)) return wood();
  const Eigen::Vector3d color = colorBetween({110, 105, 95}, {190, 180, 165});
  const Pattern pattern = chance(0.6) ? Pattern::Checker : Pattern::Mottled;
  return add({"", near(color, 0.05), pattern, between(0.2, 0.5), between(0.12, 0.25)});
}

std::size_t FurnitureKit::ceiling()
{
  return add({"", near({225, 225, 222}, 0.03), Pattern::Mottled, 0.3, 0.06});
}

SceneObject objectOf(const std::string& label, bool orientationDefined)
{
  SceneObject object;
  object.label = label;
  object.orientationDefined = orientationDefined;
  return object;
}

double inMillimetres(double metres) { return std::round(1000 * metres) / 1000; }

double inTenthsOfDegrees(double radians)
{
  const double degrees = mrpt::RAD2DEG(mrpt::math::wrapToPi(radians));  // as a pose has them
  return mrpt::DEG2RAD(std::round(10 * degrees) / 10);
}

namespace
{
constexpr double kThinnest = 1e-3;  // a scene file has no thinner parts [m]

void addPart(
    SceneObject& object,
    Shape shape,
    const Eigen::Vector3d& center,
    const Eigen::Vector3d& size,
    std::size_t material,
    double yaw,
    double pitch)
{
  Primitive part;
  part.shape = shape;
  const Eigen::Vector3d at = center.unaryExpr(&inMillimetres);
  part.T_obj_prim = {at.x(), at.y(), at.z(), inTenthsOfDegrees(yaw), inTenthsOfDegrees(pitch), 0};
  part.halfSize = 0.5 * size.unaryExpr(&inMillimetres).cwiseMax(kThinnest);
  part.material = material;
  object.parts.push_back(part);
}

}  // namespace

void addBox(
    SceneObject& object,
    const Eigen::Vector3d& center,
    const Eigen::Vector3d& size,
    std::size_t material,
    double yaw,
    double pitch)
{
  addPart(object, Shape::Box, center, size, material, yaw, pitch);
}

void addCylinder(
    SceneObject& object,
    const Eigen::Vector3d& center,
    const Eigen::Vector3d& size,
    std::size_t material)
{
  addPart(object, Shape::Cylinder, center, size, material, 0, 0);
}

void addEllipsoid(
    SceneObject& object,
    const Eigen::Vector3d& center,
    const Eigen::Vector3d& size,
    std::size_t material,
    double yaw,
    double pitch)
{
  addPart(object, Shape::Ellipsoid, center, size, material, yaw, pitch);
}

void addLegs(
    SceneObject& object,
    const Eigen::Vector2d& reach,
    double height,
    double thickness,
    bool round,
    std::size_t material)
{
  for (const double x : {-reach.x(), reach.x()})
    for (const double y : {-reach.y(), reach.y()})
      addPart(
          object, round ? Shape::Cylinder : Shape::Box, {x, y, height / 2},
          {thickness, thickness, height}, material, 0, 0);
}

}  // namespace quadmap::simulator
