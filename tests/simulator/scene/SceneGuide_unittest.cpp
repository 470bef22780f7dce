#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <map>
#include <set>
#include <sstream>

#include "../SceneFixture.h"
#include "quadmap/base/ConfigCheck.h"
#include "quadmap/simulator/Simulator.h"

// Checks what the guide says about scenes.

namespace quadmap::simulator
{
namespace
{
const std::string kGuide = QUADMAP_SOURCE_DIR "/doc/guide/write-a-scene.md";
const std::string kReference = QUADMAP_SOURCE_DIR "/doc/guide/scene-reference.md";
const std::string kFurniture = QUADMAP_SOURCE_DIR "/share/quadmap/scenes/common/furniture.ini";

TEST(SceneGuide, ItsExampleIsTheRoomItShows)
{
  const std::string guide = readFile(kGuide), fence = "```ini\n";
  const auto begin = guide.find(fence) + fence.size();
  const TemporaryFolder folder;
  Scene scene =
      readScene(folder.write("my_room.ini", guide.substr(begin, guide.find("```", begin) - begin)));
  ASSERT_EQ(2U, scene.objects.size());
  const SceneObject &cup = scene.objects[0], &table = scene.objects[1];
  EXPECT_EQ("cup", cup.label);
  EXPECT_FALSE(cup.orientationDefined);
  EXPECT_EQ("dining table", table.label);
  EXPECT_NEAR(20, mrpt::RAD2DEG(table.T_world_obj.yaw()), 1e-9);
  const Ellipsoid top = table.truth(), thing = cup.truth();
  EXPECT_NEAR(
      top.center().z() + top.semiAxes().z(), thing.center().z() - thing.semiAxes().z(), 1e-9)
      << "the cup stands on the table";

  scene.options.resize(160, 120);
  scene.options.scaleNoise(0);
  const Simulator simulator(scene, LabelTable::installed(), 1);
  ASSERT_EQ(120U, simulator.frameCount());
  for (std::size_t k = 0; k < 4; ++k)
  {
    double nearest = 9;
    for (const auto& pose : simulator.truePoses())
      nearest = std::min(
          nearest, (transformed(pose, Eigen::Vector3d::Zero()) - scene.waypoints[k].eye).norm());
    EXPECT_LT(nearest, 0.12) << "it passes waypoint " << k + 1 << ", bobbing, 8 cm a frame";
  }
  for (const std::size_t i : {0U, 40U, 80U})
  {
    const auto frame = simulator.frame(i);
    ASSERT_FALSE(frame.visible.empty()) << "looks at the table";
    EXPECT_EQ("dining table", frame.objects->objects.back().label);
  }
}

/** First and second cells of the table rows below a heading that begin with `NAME`. */
std::map<std::string, std::string> rowsBelow(const std::string& heading)
{
  std::istringstream reference(readFile(kReference));
  std::map<std::string, std::string> rows;
  bool below = false;
  for (std::string line; std::getline(reference, line);)
  {
    if (line.compare(0, 1, "#") == 0) below = line.find("# " + heading) != std::string::npos;
    if (!below || line.compare(0, 3, "| `") != 0) continue;
    const auto nameEnd = line.find("` |"), end = line.find(" |", nameEnd + 3);
    const std::string name = line.substr(3, nameEnd - 3);
    EXPECT_TRUE(rows.emplace(name, line.substr(nameEnd + 4, end - nameEnd - 4)).second) << name;
  }
  return rows;
}

/** The names of sections "[kind NAME]" of furniture.ini. */
std::set<std::string> furniture(const std::string& kind)
{
  const mrpt::config::CConfigFile file(kFurniture);
  std::vector<std::string> sections;
  file.getAllSections(sections);
  std::set<std::string> names;
  for (const auto& section : sections)
    if (section.compare(0, kind.size() + 1, kind + " ") == 0)
      names.insert(section.substr(kind.size() + 1));
  return names;
}

TEST(SceneGuide, ListsEveryModelWithItsSize)
{
  const auto rows = rowsBelow("Models");
  const auto models = furniture("model");
  EXPECT_EQ(models.size(), rows.size());
  ASSERT_GE(models.size(), 30U);
  std::string text = kRoomText + "[include]\nfile1 = common/furniture.ini\n";
  for (const auto& name : models)
    text += "[object " + name + "]\nlabel = none\nposition = 0 0 0\nmodel = " + name + "\n";
  for (const auto& object : sceneFromText(text).objects)
  {
    const Eigen::Vector3d size = 2 * object.truth().semiAxes();
    const auto expected = mrpt::format("%.3f %.3f %.3f", size.x(), size.y(), size.z());
    EXPECT_EQ(expected, rows.count(object.name) ? rows.at(object.name) : "not listed")
        << object.name;
  }
}

TEST(SceneGuide, ListsEveryMaterialWithItsColor)
{
  const auto rows = rowsBelow("Materials");
  const mrpt::config::CConfigFile file(kFurniture);
  for (const auto& name : furniture("material"))
    EXPECT_EQ(
        file.read_string("material " + name, "color", ""),
        rows.count(name) ? rows.at(name) : "not listed")
        << name;
  EXPECT_EQ(furniture("material").size(), rows.size());
}

using Values = std::map<std::string, std::string>;

std::string textOf(double value) { return mrpt::format("%.10g", value); }
std::string flagText(bool value) { return value ? "yes" : "no"; }

Values cameraDefaults()
{
  const CameraOptions o;
  return {
      {      "width",       textOf(o.width)},
      {     "height",      textOf(o.height)},
      {      "focal",       textOf(o.focal)},
      { "focalError",  textOf(o.focalError)},
      {   "exposure",    textOf(o.exposure)},
      { "colorNoise",  textOf(o.colorNoise)},
      {"jpegQuality", textOf(o.jpegQuality)},
      {   "position",               "0 0 0"},
      {    "yaw_deg",     textOf(o.yaw_deg)},
      {  "pitch_deg",   textOf(o.pitch_deg)},
      {   "roll_deg",    textOf(o.roll_deg)},
      {      "delay",       textOf(o.delay)}
  };
}

Values trajectoryDefaults()
{
  const TrajectoryOptions o;
  return {
      {     "kind", o.kind == Motion::Walk ? "walk" : ""},
      {   "frames",                     textOf(o.frames)},
      {   "rounds",                     textOf(o.rounds)},
      { "duration",                   textOf(o.duration)},
      {"startTime",                  textOf(o.startTime)},
      {      "bob",                        textOf(o.bob)},
      { "sway_deg",                   textOf(o.sway_deg)},
      { "stepRate",                   textOf(o.stepRate)}
  };
}

Values depthDefaults()
{
  const DepthNoiseOptions o;
  return {
      {       "axialBase",        textOf(o.axialBase)},
      {     "axialGrowth",      textOf(o.axialGrowth)},
      {          "window",           textOf(o.window)},
      {   "disparityStep",    textOf(o.disparityStep)},
      {        "baseline",         textOf(o.baseline)},
      {     "sensorFocal",      textOf(o.sensorFocal)},
      {         "lateral",          textOf(o.lateral)},
      {        "edgeJump",         textOf(o.edgeJump)},
      {       "edgeHoles",        textOf(o.edgeHoles)},
      {      "edgeFlying",       textOf(o.edgeFlying)},
      {        "dropouts",         textOf(o.dropouts)},
      {"maxIncidence_deg", textOf(o.maxIncidence_deg)},
      {        "minRange",         textOf(o.minRange)},
      {        "maxRange",         textOf(o.maxRange)},
      {          "shadow",         flagText(o.shadow)},
      {        "bleeding",         textOf(o.bleeding)},
      {       "darkHoles",        textOf(o.darkHoles)},
      {       "darkNoise",        textOf(o.darkNoise)},
      {      "scaleError",       textOf(o.scaleError)},
      {            "warp",             textOf(o.warp)},
      {          "wiggle",           textOf(o.wiggle)}
  };
}

Values odometryDefaults()
{
  const OdometryOptions o;
  return {
      {  "translationPerMetre",   textOf(o.translationPerMetre)},
      { "rotationPerMetre_deg",  textOf(o.rotationPerMetre_deg)},
      { "translationPerRadian",  textOf(o.translationPerRadian)},
      {"rotationPerRadian_deg", textOf(o.rotationPerRadian_deg)},
      {                "scale",                 textOf(o.scale)}
  };
}

Values detectorDefaults()
{
  const DetectorOptions o;
  return {
      {          "jitter",                                 textOf(o.jitter)},
      {  "relativeJitter",                         textOf(o.relativeJitter)},
      {      "minVisible",                             textOf(o.minVisible)},
      {         "minSize",                                textOf(o.minSize)},
      {        "missRate",                               textOf(o.missRate)},
      {"occludedMissRate",                       textOf(o.occludedMissRate)},
      {     "falseAlarms",                            textOf(o.falseAlarms)},
      {        "flipRate",                               textOf(o.flipRate)},
      {          "output", o.output == DetectorOutput::Boxes ? "boxes" : ""},
      {      "maskJitter",                             textOf(o.maskJitter)},
      {     "instanceIds",                          flagText(o.instanceIds)},
      {   "viewAngle_deg",                          textOf(o.viewAngle_deg)},
      {       "viewEdges",                              textOf(o.viewEdges)},
      {      "viewMisses",                             textOf(o.viewMisses)},
      {       "viewFlips",                              textOf(o.viewFlips)},
      {       "viewParts",                              textOf(o.viewParts)},
      {     "viewMergers",                            textOf(o.viewMergers)}
  };
}

/** The keys that a section may have, as the message about a wrong one names them. */
std::set<std::string> keysOf(const std::string& section)
{
  std::string text = kRoomText;
  const std::string wrong = "no_such_key = 1\n";
  if (section == "trajectory")
    text += wrong;  // its last section
  else
    text += "[" + section + "]\n" + wrong;
  const std::string message = errorOf([&] { sceneFromText(text); }), known = "known: ";
  std::istringstream list(message.substr(message.find(known) + known.size()));
  std::set<std::string> keys;
  for (std::string key; list >> key;)
    if (key.compare(0, 8, "waypoint") != 0) keys.insert(key.substr(0, key.find(',')));
  return keys;
}

TEST(SceneGuide, ListsEveryKeyWithItsDefault)
{
  for (const auto& [section, defaults] : {
           std::pair{     "camera",     cameraDefaults()},
           { "trajectory", trajectoryDefaults()},
           {"depth_noise",      depthDefaults()},
           {   "odometry",   odometryDefaults()},
           {   "detector",   detectorDefaults()}
  })
  {
    EXPECT_EQ(defaults, rowsBelow("`[" + std::string(section) + "]`"));
    std::set<std::string> keys;
    for (const auto& item : defaults) keys.insert(item.first);
    EXPECT_EQ(keysOf(section), keys) << section;
  }
}

}  // namespace
}  // namespace quadmap::simulator
