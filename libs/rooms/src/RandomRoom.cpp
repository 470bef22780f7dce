#include "quadmap/rooms/RandomRoom.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "FurnitureKit.h"
#include "RoomSteps.h"
#include "quadmap/simulator/CameraPath.h"

namespace quadmap::simulator
{
namespace
{
constexpr std::uint64_t kAttempts = 50;
constexpr double kWalkers = 0.4;  // share of the rooms through which somebody walks

/** Whether the camera stays out of all things, at every frame. */
bool wayIsFree(const Scene& scene)
{
  std::vector<double> instants;
  for (int i = 0; i < scene.options.trajectory.frames; ++i) instants.push_back(i);
  try
  {
    robotPath(scene, scene.options.trajectory, instants);
    return true;
  }
  catch (const std::runtime_error&)
  {
    return false;
  }
}

}  // namespace

Scene randomRoom(std::uint64_t seed)
{
  for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt)
  {
    RandomStream random(seed, Purpose::Room, attempt);
    Scene scene;
    FurnitureKit kit(random, scene.materials);
    furnishRoom(scene, kit);
    if (!planTour(scene, kit) || !wayIsFree(scene)) continue;
    if (kit.chance(kWalkers)) addWalker(scene, kit);
    drawSensors(scene.options, kit);
    std::sort(
        scene.objects.begin(), scene.objects.end(),
        [](const SceneObject& a, const SceneObject& b) { return a.name < b.name; });
    return scene;
  }
  throw std::runtime_error(mrpt::format(
      "random room %llu: no way for the camera was found", static_cast<unsigned long long>(seed)));
}

}  // namespace quadmap::simulator
