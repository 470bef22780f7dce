#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <cmath>
#include <sstream>

#include "quadmap/base/OptionList.h"
#include "quadmap/rooms/RandomRoom.h"

namespace quadmap::simulator
{
namespace
{
std::string textOf(const Eigen::Vector3d& v)
{
  return exactText(v.x()) + " " + exactText(v.y()) + " " + exactText(v.z());
}

/** Degrees that read back as the same angle, up to the last digits of a double. */
std::string degrees(double radians)
{
  return exactText(std::round(mrpt::RAD2DEG(radians) * 1e9) / 1e9);
}

const char* nameOf(Pattern pattern)
{
  if (pattern == Pattern::Checker) return "checker";
  return pattern == Pattern::Stripes ? "stripes" : "mottled";
}

const char* nameOf(Shape shape)
{
  if (shape == Shape::Cylinder) return "cylinder";
  return shape == Shape::Ellipsoid ? "ellipsoid" : "box";
}

std::string partText(const Primitive& part, const std::vector<Material>& materials)
{
  const auto& t = part.T_obj_prim;
  std::string text = std::string(nameOf(part.shape)) + "  " + textOf({t.x(), t.y(), t.z()}) + "  " +
                     textOf(2 * part.halfSize) + "  " + materials[part.material].name;
  if (t.yaw() != 0 || t.pitch() != 0 || t.roll() != 0)
    text += "  " + degrees(t.yaw()) + " " + degrees(t.pitch()) + " " + degrees(t.roll());
  return text;
}

void writeObject(
    std::ostream& out, const SceneObject& object, const std::vector<Material>& materials)
{
  const auto& t = object.T_world_obj;
  out << "\n[object " << object.name
      << "]\nlabel = " << (object.label.empty() ? "none" : object.label)
      << "\nposition = " << textOf({t.x(), t.y(), t.z()}) << "\nyaw_deg = " << degrees(t.yaw())
      << "\n";
  if (!object.orientationDefined) out << "orientation_defined = no\n";
  if (std::isfinite(object.from)) out << "from = " << exactText(object.from) << "\n";
  if (std::isfinite(object.to)) out << "to = " << exactText(object.to) << "\n";
  std::size_t point = 0, number = 0;
  for (const auto& [time, pose] : object.way)
    out << "way" << ++point << " = " << exactText(time) << "  "
        << textOf({pose.x(), pose.y(), pose.z()}) << "  " << degrees(pose.yaw()) << "\n";
  for (const auto& part : object.parts)
    out << mrpt::format("part%03zu = ", ++number) << partText(part, materials) << "\n";
}

void writeOptions(std::ostream& out, const Scene& scene)
{
  const SimulatorOptions& options = scene.options;
  mrpt::config::CConfigFileMemory config;
  options.camera.saveToConfigFile(config, "camera");
  options.trajectory.saveToConfigFile(config, "trajectory");
  options.depthNoise.saveToConfigFile(config, "depth_noise");
  options.odometry.saveToConfigFile(config, "odometry");
  options.detector.saveToConfigFile(config, "detector");
  int number = 0;
  for (const auto& waypoint : scene.waypoints)
    config.write(
        "trajectory", "waypoint" + std::to_string(++number),
        textOf(waypoint.eye) + "  " + textOf(waypoint.target));
  out << "\n" << config.getContent();
}

}  // namespace

std::string sceneText(const Scene& scene)
{
  std::ostringstream out;
  const auto& materials = scene.materials;
  out << "[room]\nsize = " << textOf(scene.room.size)
      << "\nfloor = " << materials[scene.room.floor].name
      << "\nwalls = " << materials[scene.room.walls].name
      << "\nceiling = " << materials[scene.room.ceiling].name << "\n";
  for (const auto& material : materials)
    out << "\n[material " << material.name << "]\ncolor = " << textOf(material.color)
        << "\npattern = " << nameOf(material.pattern) << "\nscale = " << exactText(material.scale)
        << "\ncontrast = " << exactText(material.contrast)
        << "\ndepth = " << (material.depth ? "yes" : "no") << "\n";
  for (const auto& object : scene.objects) writeObject(out, object, materials);
  writeOptions(out, scene);
  return out.str();
}

}  // namespace quadmap::simulator
