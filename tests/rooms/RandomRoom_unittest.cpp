#include "quadmap/rooms/RandomRoom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "../simulator/SceneFixture.h"
#include "quadmap/simulator/Simulator.h"

namespace quadmap::simulator
{
namespace
{
constexpr std::uint64_t kSeeds = 30;

/** The rooms of all seeds, drawn once. */
const std::vector<Scene>& rooms()
{
  static const std::vector<Scene> all = []
  {
    std::vector<Scene> scenes;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) scenes.push_back(randomRoom(seed));
    return scenes;
  }();
  return all;
}

bool contains(const SceneObject& object, const Eigen::Vector3d& world)
{
  const Eigen::Vector3d p = inverted(object.T_world_obj, world);
  return std::any_of(
      object.parts.begin(), object.parts.end(),
      [&](const Primitive& part) { return isInside(part, inverted(part.T_obj_prim, p)); });
}

/** Points of an object, at most 1 % and 3 mm below its surface. */
std::vector<Eigen::Vector3d> pointsOf(const SceneObject& object, std::mt19937& random)
{
  std::vector<Eigen::Vector3d> points;
  for (const auto& part : object.parts)
    for (int i = 0; i < 25; ++i)
    {
      const Eigen::Vector3d p = surfacePoint(part, random);
      const Eigen::Vector3d depth = Eigen::Vector3d::Constant(3e-3).cwiseMin(part.halfSize);
      const Eigen::Vector3d inner = p.array() * (1 - depth.array() / part.halfSize.array());
      points.push_back(transformed(object.T_world_obj + part.T_obj_prim, inner));
    }
  return points;
}

TEST(RandomRoom, IsTheSameForASeedAndAnotherForAnother)
{
  std::set<std::string> texts;
  for (const auto& room : rooms()) texts.insert(sceneText(room));
  EXPECT_EQ(kSeeds, texts.size());
  EXPECT_TRUE(sceneText(rooms()[6]) == sceneText(randomRoom(7)));
}

TEST(RandomRoom, NothingIsInsideAnotherThingOrOutsideTheWalls)
{
  std::mt19937 random(1);
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
  {
    const Scene& room = rooms()[seed - 1];
    const Eigen::Vector3d half = room.room.size / 2;
    for (const auto& object : room.objects)
    {
      if (!object.way.empty()) continue;
      for (const auto& p : pointsOf(object, random))
      {
        EXPECT_LT(std::abs(p.x()), half.x() + 1e-3) << seed << " " << object.name;
        EXPECT_LT(std::abs(p.y()), half.y() + 1e-3) << seed << " " << object.name;
        EXPECT_GT(p.z(), -1e-3) << seed << " " << object.name;
        EXPECT_LT(p.z(), room.room.size.z() + 1e-3) << seed << " " << object.name;
        for (const auto& other : room.objects)
          if (&other != &object && other.way.empty() && contains(other, p))
            ADD_FAILURE() << "seed " << seed << ": " << object.name << " is in " << other.name;
      }
    }
  }
}

/** Whether something is just below some point of the lower side of an object's cuboid. */
bool standsOnSomething(const Scene& room, const SceneObject& object)
{
  const Ellipsoid box = object.truth();
  const Eigen::Vector3d half = box.semiAxes();
  if (box.center().z() - half.z() < 2e-3) return true;
  for (double x = -0.95; x < 1; x += 0.1)
    for (double y = -0.95; y < 1; y += 0.1)
    {
      const Eigen::Vector3d corner(x * half.x(), y * half.y(), -half.z() - 2e-3);
      const Eigen::Vector3d p = box.center() + box.rotation() * corner;
      for (const auto& other : room.objects)
        if (&other != &object && contains(other, p)) return true;
    }
  return false;
}

/** Whether an object is at a wall or at the ceiling, to a decimetre, or hangs on a cord. */
bool hangs(const Scene& room, const SceneObject& object)
{
  const Ellipsoid box = object.truth();
  const Eigen::Vector3d above = box.center() + Eigen::Vector3d(0, 0, box.semiAxes().z() + 5e-3);
  for (const auto& other : room.objects)
    if (object.label == "lamp" && other.label.empty() && contains(other, above)) return true;
  const Eigen::Vector3d half = box.rotation().cwiseAbs() * box.semiAxes();
  const Eigen::Vector3d far = box.center().cwiseAbs() + half;
  return far.x() > room.room.size.x() / 2 - 0.1 || far.y() > room.room.size.y() / 2 - 0.1 ||
         box.center().z() + half.z() > room.room.size.z() - 0.01;
}

/** Whether an object is the panel of a screen whose stand, a thing of its own, stands. */
bool isOnStand(const Scene& room, const SceneObject& object)
{
  const auto& at = object.T_world_obj;
  return std::any_of(
      room.objects.begin(), room.objects.end(),
      [&](const SceneObject& other)
      {
        return &other != &object && other.label.empty() && at.distanceTo(other.T_world_obj) == 0 &&
               standsOnSomething(room, other);
      });
}

TEST(RandomRoom, EverythingStandsOrHangs)
{
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    for (const auto& object : rooms()[seed - 1].objects)
      EXPECT_TRUE(
          standsOnSomething(rooms()[seed - 1], object) || hangs(rooms()[seed - 1], object) ||
          isOnStand(rooms()[seed - 1], object))
          << "seed " << seed << ": " << object.name;
}

TEST(RandomRoom, ScreensAreTheirPanelsAlone)
{
  int onStands = 0;
  for (const auto& room : rooms())
    for (const auto& object : room.objects)
    {
      if (object.label != "tv" && object.label != "monitor") continue;
      EXPECT_LT(2 * object.truth().semiAxes().x(), 0.09) << object.name << ", with its foot .16 m";
      onStands += isOnStand(room, object) ? 1 : 0;
    }
  EXPECT_GT(onStands, 10);
}

TEST(RandomRoom, TheCameraKeepsAwayFromAllThings)
{
  constexpr double kNear = 0.15;  // [m]
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    const Simulator simulator(rooms()[seed - 1], LabelTable::installed(), 1);
    EXPECT_GE(simulator.frameCount(), 150U);
    EXPECT_LE(simulator.frameCount(), 250U);
    for (const auto& pose : simulator.truePoses())
      for (int k = 0; k < 8; ++k)
      {
        const double a = M_PI / 4 * k;
        const Eigen::Vector3d p(
            pose.x() + kNear * std::cos(a), pose.y() + kNear * std::sin(a), pose.z());
        for (const auto& object : simulator.scene().objects)
          EXPECT_FALSE(object.way.empty() && contains(object, p)) << seed << " " << object.name;
      }
  }
}

TEST(RandomRoom, TheCameraSeesWhatIsThere)
{
  for (const std::uint64_t seed : {3, 8, 16})
  {
    Scene scene = rooms()[seed - 1];
    scene.options.resize(96, 72);
    scene.options.detector.minSize = 20;
    const Simulator simulator(scene, LabelTable::installed(), 1);
    std::map<std::size_t, int> seen;
    for (std::size_t i = 0; i < simulator.frameCount(); i += 3)
      for (const auto& object : simulator.frame(i).visible) ++seen[object.object];
    double total = 0, well = 0;
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
      if (!scene.objects[i].label.empty()) ++total, well += seen[i] >= 3;
    EXPECT_GE(well / total, 0.75) << "seed " << seed;
  }
}

TEST(RandomRoom, RoomsDiffer)
{
  std::set<std::string> labels;
  std::map<std::string, std::vector<double>> heights;
  int walkers = 0, stereo = 0, timeOfFlight = 0;
  std::size_t fewest = 1000;
  for (const auto& room : rooms())
  {
    std::size_t labelled = 0;
    for (const auto& object : room.objects)
    {
      if (!object.label.empty()) ++labelled, labels.insert(object.label);
      heights[object.label].push_back(2 * object.truth().semiAxes().z());
      walkers += object.way.empty() ? 0 : 1;
    }
    fewest = std::min(fewest, labelled);
    stereo += room.options.depthNoise.bleeding > 0 ? 1 : 0;
    timeOfFlight += room.options.depthNoise.wiggle > 0 ? 1 : 0;
  }
  EXPECT_GE(labels.size(), 30U);
  EXPECT_GE(fewest, 8U);
  EXPECT_GT(momentsOf(heights["chair"]).deviation, 0.06) << "[m]";
  EXPECT_GT(momentsOf(heights["bookshelf"]).deviation, 0.2) << "[m]";
  EXPECT_GE(walkers, 4);
  EXPECT_GE(stereo, 4);
  EXPECT_GE(timeOfFlight, 4);
  EXPECT_GE(static_cast<int>(kSeeds) - stereo - timeOfFlight, 4) << "structured light";
}

TEST(RandomRoom, ItsFileReadsBackAsTheSameScene)
{
  for (const auto& room : rooms())
  {
    const std::string text = sceneText(room);
    const Scene again = sceneFromText(text);
    EXPECT_TRUE(text == sceneText(again));
    ASSERT_EQ(room.objects.size(), again.objects.size());
    for (std::size_t i = 0; i < room.objects.size(); ++i)
    {
      EXPECT_EQ(room.objects[i].name, again.objects[i].name);
      const auto a = room.objects[i].truth(), b = again.objects[i].truth();
      EXPECT_EQ(a.center(), b.center()) << room.objects[i].name << ", to the last bit";
      EXPECT_EQ(a.semiAxes(), b.semiAxes()) << room.objects[i].name;
      EXPECT_EQ(a.rotation(), b.rotation()) << room.objects[i].name;
    }
  }
}

}  // namespace
}  // namespace quadmap::simulator
