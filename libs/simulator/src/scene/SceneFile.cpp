#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/ShareFiles.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/simulator/Scene.h"
#include "scene/SceneConfig.h"
#include "scene/SceneText.h"
#include "scene/WaypointText.h"

namespace quadmap::simulator
{
namespace
{
using Parts = std::vector<Primitive>;

/** Reads the sections of one file into a scene. */
class SceneReader
{
 public:
  explicit SceneReader(const SceneConfig& config) :
      file_(config.config()), sections_(config.sections())
  {
  }

  Scene read()
  {
    readMaterials();
    readRoom();
    for (const auto& section : sectionsOf("model")) readModel(section);
    for (const auto& section : sectionsOf("object")) readObject(section);
    auto& options = scene_.options;
    readCameras();
    options.trajectory.loadFromConfigFile(file_, "trajectory");
    scene_.waypoints = readWaypoints(file_, options.trajectory.kind);
    options.depthNoise.loadFromConfigFile(file_, "depth_noise");
    options.odometry.loadFromConfigFile(file_, "odometry");
    options.detector.loadFromConfigFile(file_, "detector");
    rejectOtherSections();
    return std::move(scene_);
  }

 private:
  static constexpr double kFar = 100;      // no coordinate of a room is larger [m]
  static constexpr double kLongest = 1e5;  // no recording is longer [s]

  /** The sections "[kind NAME]". */
  std::vector<std::string> sectionsOf(const std::string& kind) const
  {
    std::vector<std::string> result;
    for (const auto& section : sections_)
      if (section.compare(0, kind.size() + 1, kind + " ") == 0) result.push_back(section);
    std::sort(result.begin(), result.end());
    return result;
  }

  static std::string nameOf(const std::string& section)
  {
    return mrpt::system::trim(section.substr(section.find(' ')));
  }

  void rejectOtherSections() const
  {
    const std::set<std::string> known{"room",        "camera",   "trajectory",
                                      "depth_noise", "odometry", "detector"};
    for (const auto& section : sections_)
    {
      const std::string kind = section.substr(0, section.find(' '));
      const bool named = section != kind && (kind == "material" || kind == "model" ||
                                             kind == "object" || kind == "camera");
      if (!named && known.count(section) == 0)
        throw std::invalid_argument("[" + section + "] unknown section");
    }
  }

  Entry required(const std::string& section, const std::string& key) const
  {
    const auto found = entryOf(file_, section, key);
    if (!found) throw std::invalid_argument("[" + section + "] " + key + ": is missing");
    return *found;
  }

  Eigen::Vector3d requiredVector(
      const std::string& section, const std::string& key, double min, double max) const
  {
    return required(section, key).vector(min, max);
  }

  /** The keys of a section that start with one of the prefixes. All other keys must be known. */
  std::vector<std::string> keysOf(
      const std::string& section,
      const std::vector<std::string>& prefixes,
      std::set<std::string> known) const
  {
    std::vector<std::string> keys, result;
    file_.getAllKeys(section, keys);
    for (const auto& key : keys)
      for (const auto& prefix : prefixes)
        if (key.compare(0, prefix.size(), prefix) == 0) result.push_back(key);
    known.insert(result.begin(), result.end());
    rejectUnknownKeys(file_, section, known);
    return result;
  }

  void readMaterials()
  {
    for (const auto& section : sectionsOf("material"))
    {
      rejectUnknownKeys(file_, section, {"color", "pattern", "scale", "contrast", "depth"});
      Material material;
      material.name = nameOf(section);
      material.color = requiredVector(section, "color", 0, 255);
      if (const auto e = entryOf(file_, section, "pattern")) material.pattern = patternOf(*e);
      readNumber(file_, section, "scale", material.scale, 0.001, 10);
      readNumber(file_, section, "contrast", material.contrast, 0, 1);
      readFlag(file_, section, "depth", material.depth);
      materialIndex_[material.name] = scene_.materials.size();
      scene_.materials.push_back(material);
    }
  }

  static Pattern patternOf(const Entry& e)
  {
    if (e.text == "mottled") return Pattern::Mottled;
    if (e.text == "checker") return Pattern::Checker;
    if (e.text == "stripes") return Pattern::Stripes;
    e.reject("must be mottled, checker or stripes");
  }

  std::size_t materialOf(const Entry& e, const std::string& name) const
  {
    const auto found = materialIndex_.find(name);
    if (found == materialIndex_.end()) e.reject("there is no [material " + name + "]");
    return found->second;
  }

  void readRoom()
  {
    rejectUnknownKeys(file_, "room", {"size", "floor", "walls", "ceiling"});
    Room& room = scene_.room;
    room.size = requiredVector("room", "size", 1, kFar);
    for (auto [key, index] : {
             std::pair{  "floor",   &room.floor},
             {  "walls",   &room.walls},
             {"ceiling", &room.ceiling}
    })
    {
      const Entry e = required("room", key);
      *index = materialOf(e, e.text);
    }
  }

  void readModel(const std::string& section)
  {
    Parts& parts = models_[nameOf(section)];
    for (const auto& key : keysOf(section, {"part"}, {}))
      parts.push_back(partOf(required(section, key)));
    if (parts.empty()) throw std::invalid_argument("[" + section + "] has no part");
  }

  /** Reads SHAPE  center x y z  size x y z  MATERIAL  [yaw [pitch [roll]]]. */
  Primitive partOf(const Entry& e) const
  {
    const auto words = wordsOf(e.text);
    if (words.size() < 8 || words.size() > 11)
      e.reject("expected: shape, center x y z, size x y z, material, [yaw pitch roll in degrees]");
    Primitive part;
    part.shape = shapeOf(e, words[0]);
    const Eigen::Vector3d center = e.vector(words, 1, -kFar, kFar);
    part.halfSize = 0.5 * e.vector(words, 4, 0.001, kFar);
    part.material = materialOf(e, words[7]);
    double angles[3] = {0, 0, 0};
    for (std::size_t i = 8; i < words.size(); ++i)
      angles[i - 8] = mrpt::DEG2RAD(e.number(words[i], -360, 360));
    part.T_obj_prim =
        mrpt::poses::CPose3D(center.x(), center.y(), center.z(), angles[0], angles[1], angles[2]);
    return part;
  }

  static Shape shapeOf(const Entry& e, const std::string& word)
  {
    if (word == "box") return Shape::Box;
    if (word == "cylinder") return Shape::Cylinder;
    if (word == "ellipsoid") return Shape::Ellipsoid;
    e.reject("the shape must be box, cylinder or ellipsoid");
  }

  void readObject(const std::string& section)
  {
    SceneObject object;
    object.name = nameOf(section);
    object.label = required(section, "label").text;
    if (object.label == "none") object.label.clear();
    const Eigen::Vector3d position = requiredVector(section, "position", -kFar, kFar);
    double yaw_deg = 0;
    readNumber(file_, section, "yaw_deg", yaw_deg, -360, 360);
    readFlag(file_, section, "orientation_defined", object.orientationDefined);
    readNumber(file_, section, "from", object.from, 0, kLongest);
    readNumber(file_, section, "to", object.to, 0, kLongest);
    if (!(object.from < object.to))
      throw std::invalid_argument("[" + section + "] from: must be before `to`");
    object.T_world_obj = mrpt::poses::CPose3D(
        position.x(), position.y(), position.z(), mrpt::DEG2RAD(yaw_deg), 0, 0);

    if (const auto e = entryOf(file_, section, "model")) object.parts = modelOf(*e);
    const std::set<std::string> known{
        "label", "model", "position", "yaw_deg", "orientation_defined", "from", "to"};
    for (const auto& key : keysOf(section, {"part", "move", "way"}, known))
      if (key.compare(0, 4, "part") == 0) object.parts.push_back(partOf(required(section, key)));
    if (object.parts.empty())
      throw std::invalid_argument("[" + section + "] has neither a model nor a part");
    for (const auto& point : numberedEntries(file_, section, "way")) goOn(object, point);
    for (const auto& move : numberedEntries(file_, section, "move"))
      object.way.empty() ? stayUntilMoved(object, move)
                         : move.reject("what goes a way cannot be moved as well");
    scene_.objects.push_back(std::move(object));
  }

  /** A time [s] and a place: time x y z yaw_deg. */
  static WayPoint wayPointOf(const Entry& e)
  {
    const auto words = wordsOf(e.text);
    if (words.size() != 5) e.reject("expected: time [s], x y z, yaw in degrees");
    const Eigen::Vector3d p = e.vector(words, 1, -kFar, kFar);
    return {
        e.number(words[0], 0, kLongest),
        {p.x(), p.y(), p.z(), mrpt::DEG2RAD(e.number(words[4], -360, 360)), 0, 0}
    };
  }

  static void goOn(SceneObject& object, const Entry& e)
  {
    const WayPoint point = wayPointOf(e);
    if (!object.way.empty() && !(point.time > object.way.back().time))
      e.reject("must come later than what is before it");
    object.way.push_back(point);
  }

  /** Reads time x y z yaw_deg, which ends the stay at one place and begins that at the next. */
  void stayUntilMoved(SceneObject& object, const Entry& e)
  {
    const WayPoint next = wayPointOf(e);
    if (!(next.time > object.from && next.time < object.to))
      e.reject("must come later than what is before it, and earlier than `to`");
    SceneObject before = object;
    before.to = object.from = next.time;
    scene_.objects.push_back(std::move(before));
    object.T_world_obj = next.T_world_obj;
  }

  const Parts& modelOf(const Entry& e) const
  {
    const auto found = models_.find(e.text);
    if (found == models_.end()) e.reject("there is no [model " + e.text + "]");
    return found->second;
  }

  void readCameras()
  {
    auto& options = scene_.options;
    options.camera.loadFromConfigFile(file_, "camera");
    for (const auto& section : sectionsOf("camera"))
    {
      if (const auto quality = entryOf(file_, section, "jpegQuality"))
        quality->reject("is the same for all cameras, and must stand in [camera]");
      options.rig.push_back(options.camera);
      options.rig.back().name = nameOf(section);
      options.rig.back().loadFromConfigFile(file_, section);
    }
  }

  const mrpt::config::CConfigFileBase& file_;
  const std::vector<std::string>& sections_;
  std::map<std::string, std::size_t> materialIndex_;
  std::map<std::string, Parts> models_;
  Scene scene_;
};

}  // namespace

Scene readScene(const std::string& path)
{
  const SceneConfig config(path);
  try
  {
    return SceneReader(config).read();
  }
  catch (const std::invalid_argument& e)
  {
    throw std::runtime_error(config.fileOf(e.what()) + ": " + e.what());
  }
}

std::string findScene(const std::string& nameOrPath)
{
  const bool isPath = nameOrPath.find('/') != std::string::npos ||
                      std::filesystem::path(nameOrPath).extension() == ".ini";
  return isPath ? nameOrPath : findShareFile("scenes/" + nameOrPath + ".ini");
}

}  // namespace quadmap::simulator
