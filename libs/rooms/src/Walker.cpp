#include <algorithm>
#include <cmath>

#include "FreeFloor.h"
#include "FurnitureKit.h"
#include "RoomSteps.h"
#include "WallThings.h"
#include "quadmap/simulator/CameraPath.h"

namespace quadmap::simulator
{
namespace
{
constexpr double kWalkerMargin = 0.32;    // half the width of a person [m]
constexpr double kWalkerHeadroom = 1.95;  // [m]
constexpr double kApart = 0.9;            // between the person and the camera, at least [m]
constexpr double kWalkerStep = 0.5;       // between the points of the way [m]

/** Places of the camera, ten a second. */
std::vector<Eigen::Vector2d> cameraPlaces(const Scene& scene)
{
  const auto& trajectory = scene.options.trajectory;
  std::vector<double> instants;
  for (double t = 0; t < trajectory.duration; t += 0.1)
    instants.push_back(t * trajectory.frames / trajectory.duration);
  std::vector<Eigen::Vector2d> places;
  for (const auto& pose : robotPath(scene, trajectory, instants))
    places.emplace_back(pose.x(), pose.y());
  return places;
}

/** A way from place to place, at an even speed from a time on. */
std::vector<WayPoint> wayThrough(
    const FreeFloor& floor, const std::vector<std::size_t>& places, double start, double speed)
{
  std::vector<WayPoint> way;
  Eigen::Vector2d last = floor.places()[places.front()];
  double time = start, since = kWalkerStep;
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    for (const auto cell : floor.way(places[i], places[i + 1]))
    {
      const Eigen::Vector2d p = floor.places()[cell];
      const double step = (p - last).norm();
      time += step / speed;
      since += step;
      if (since < kWalkerStep)
      {
        last = p;
        continue;
      }
      const double yaw = step > 0 ? std::atan2(p.y() - last.y(), p.x() - last.x()) : 0.0;
      way.push_back({
          std::round(100 * time) / 100,
          {inMillimetres(p.x()), inMillimetres(p.y()), 0, inTenthsOfDegrees(yaw), 0, 0}
      });
      since = 0;
      last = p;
    }
  return way;
}

bool staysApart(const SceneObject& person, const std::vector<Eigen::Vector2d>& camera)
{
  for (std::size_t i = 0; i < camera.size(); ++i)
  {
    const double time = 0.1 * static_cast<double>(i);
    if (!person.standsAt(time)) continue;
    const auto pose = person.poseAt(time);
    if ((camera[i] - Eigen::Vector2d(pose.x(), pose.y())).norm() < kApart) return false;
  }
  return true;
}

}  // namespace

void addWalker(Scene& scene, FurnitureKit& kit)
{
  const FreeFloor floor(scene, kWalkerMargin, kWalkerHeadroom);
  if (floor.places().size() < 50) return;
  const auto camera = cameraPlaces(scene);
  const double duration = scene.options.trajectory.duration;
  SceneObject walker = person(kit);
  walker.name = "walker";
  for (int i = 0; i < 60; ++i)
  {
    const auto any = [&] { return kit.pick(floor.places().size()); };
    const std::size_t door = any(), goal = any(), other = any();
    const double start = kit.between(0, 0.8 * duration), speed = kit.between(0.5, 1.0);
    walker.way = wayThrough(floor, {door, goal, other, door}, start, speed);
    if (walker.way.size() < 4) continue;
    walker.T_world_obj = walker.way.front().T_world_obj;
    walker.from = walker.way.front().time;
    walker.to = walker.way.back().time;
    if (walker.to > duration || !staysApart(walker, camera)) continue;
    scene.objects.push_back(walker);
    return;
  }
}

}  // namespace quadmap::simulator
