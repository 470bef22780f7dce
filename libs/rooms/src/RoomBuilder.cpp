#include "RoomBuilder.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace quadmap::simulator
{
namespace
{
constexpr int kTries = 40;
constexpr double kWalkway = 1.9;  // what hangs higher leaves the floor free [m]

/** A pose that a scene file can hold exactly: millimetres and tenths of a degree. */
mrpt::poses::CPose3D rounded(const mrpt::poses::CPose3D& pose)
{
  return {
      inMillimetres(pose.x()),
      inMillimetres(pose.y()),
      inMillimetres(pose.z()),
      inTenthsOfDegrees(pose.yaw()),
      0,
      0};
}

/** The floor before the +x side of an object. */
UprightBox frontOf(const SceneObject& object, double depth)
{
  UprightBox box = boundsOf(object);
  const double yaw = box.yaw;
  box.center += (box.half.x() + depth / 2) * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
  box.half.x() = depth / 2;
  box.low = 0;
  box.high = kWalkway;
  return box;
}

}  // namespace

bool RoomBuilder::fits(const SceneObject& object) const
{
  const UprightBox bounds = boundsOf(object);
  if (!isInside(bounds, scene_.room)) return false;
  const auto blocks = [&](const UprightBox& kept) { return overlap(bounds, kept); };
  if (std::any_of(free_.begin(), free_.end(), blocks)) return false;
  return std::none_of(
      scene_.objects.begin(), scene_.objects.end(),
      [&](const SceneObject& other) { return collide(object, other); });
}

std::optional<std::size_t> RoomBuilder::put(SceneObject object, double freeInFront)
{
  object.T_world_obj = rounded(object.T_world_obj);
  if (!fits(object)) return std::nullopt;
  if (freeInFront > 0)
  {
    const UprightBox front = frontOf(object, freeInFront);
    if (!isInside(front, scene_.room)) return std::nullopt;
    for (const auto& other : scene_.objects)
      if (overlap(front, boundsOf(other))) return std::nullopt;
    free_.push_back(front);
  }
  add(std::move(object));
  return scene_.objects.size() - 1;
}

void RoomBuilder::add(SceneObject object)
{
  std::string name = object.label.empty() ? "thing" : object.label;
  std::replace(name.begin(), name.end(), ' ', '_');
  object.name = mrpt::format("%s_%02d", name.c_str(), ++count_[name]);
  scene_.objects.push_back(std::move(object));
}

void RoomBuilder::detach(std::size_t index, std::size_t firstPart)
{
  auto& parts = scene_.objects[index].parts;
  const auto first = parts.begin() + static_cast<std::ptrdiff_t>(firstPart);
  SceneObject rest;
  rest.T_world_obj = scene_.objects[index].T_world_obj;
  rest.parts.assign(first, parts.end());
  parts.erase(first, parts.end());
  add(std::move(rest));
}

WallPlace RoomBuilder::placeAtWall(std::size_t wall, double along) const
{
  const Eigen::Vector2d half = scene_.room.size.head<2>() / 2;
  const double yaw = M_PI / 2 * static_cast<double>(wall);
  const double distance = wall % 2 == 0 ? half.x() : half.y();
  const Eigen::Vector2d into(std::cos(yaw), std::sin(yaw)), side(-into.y(), into.x());
  const Eigen::Vector2d p = -distance * into + along * side;
  return {
      {p.x(), p.y(), 0, yaw, 0, 0},
      2 * (wall % 2 == 0 ? half.y() : half.x())
  };
}

std::optional<std::size_t> RoomBuilder::putAtWall(
    const SceneObject& object, double freeInFront, double lift, double gap)
{
  SceneObject placed = object;
  placed.T_world_obj = {};
  const UprightBox bounds = boundsOf(placed);
  for (int i = 0; i < kTries; ++i)
  {
    const std::size_t wall = kit_.pick(4);
    const double reach = placeAtWall(wall, 0).length / 2 - bounds.half.y();
    if (reach <= 0) continue;
    const double along = kit_.between(-reach, reach);
    const double turn = lift > 0 ? 0 : kit_.gaussian(mrpt::DEG2RAD(1.5));
    const double back = bounds.half.x() - bounds.center.x();
    const double away = back + gap + bounds.half.y() * std::abs(std::sin(turn));
    placed.T_world_obj =
        placeAtWall(wall, along).T_world_place + mrpt::poses::CPose3D(away, 0, lift, turn, 0, 0);
    if (const auto index = put(placed, freeInFront)) return index;
  }
  return std::nullopt;
}

std::optional<std::size_t> RoomBuilder::putInTheMiddle(const SceneObject& object, double around)
{
  SceneObject placed = object;
  const Eigen::Vector2d half = scene_.room.size.head<2>() / 2;
  for (int i = 0; i < kTries; ++i)
  {
    const double quarters = static_cast<double>(kit_.pick(4));
    const double yaw = M_PI / 2 * quarters + kit_.gaussian(0.12);
    placed.T_world_obj = {
        kit_.between(-half.x(), half.x()), kit_.between(-half.y(), half.y()), 0, yaw, 0, 0};
    UprightBox floor = grown(boundsOf(placed), around);
    floor.low = 0;
    if (!isInside(floor, scene_.room)) continue;
    const bool isFree = std::none_of(
        scene_.objects.begin(), scene_.objects.end(),
        [&](const SceneObject& other) { return overlap(floor, boundsOf(other)); });
    if (!isFree) continue;
    if (const auto index = put(placed)) return index;
  }
  return std::nullopt;
}

std::optional<std::size_t> RoomBuilder::putOnTheFloor(const SceneObject& object)
{
  SceneObject placed = object;
  const Eigen::Vector2d half = scene_.room.size.head<2>() / 2;
  for (int i = 0; i < kTries; ++i)
  {
    placed.T_world_obj = {
        kit_.between(-half.x(), half.x()),
        kit_.between(-half.y(), half.y()),
        0,
        kit_.between(-M_PI, M_PI),
        0,
        0};
    if (const auto index = put(placed)) return index;
  }
  return std::nullopt;
}

std::optional<std::size_t> RoomBuilder::putOnShelf(
    const SceneObject& thing, std::size_t piece, const Shelf& shelf, std::optional<double> yaw)
{
  SceneObject probe = thing;
  for (int i = 0; i < kTries; ++i)
  {
    const double turn = yaw ? *yaw + kit_.gaussian(0.05) : kit_.between(-M_PI, M_PI);
    probe.T_world_obj = {0, 0, 0, turn, 0, 0};
    const UprightBox bounds = boundsOf(probe);
    if (bounds.high > shelf.headroom) return std::nullopt;
    const double c = std::abs(std::cos(turn)), s = std::abs(std::sin(turn));
    const Eigen::Vector2d half(
        c * bounds.half.x() + s * bounds.half.y(), s * bounds.half.x() + c * bounds.half.y());
    const Eigen::Vector2d reach = shelf.half - half;
    if (reach.minCoeff() < 0) continue;
    const double aside = kit_.between(-reach.y(), reach.y());
    const Eigen::Vector2d off(kit_.between(-reach.x(), reach.x()), aside);
    const Eigen::Vector2d at = shelf.center - bounds.center + off;
    if (const auto index = putBeside(thing, piece, {at.x(), at.y(), shelf.z, turn, 0, 0}))
      return index;
  }
  return std::nullopt;
}

std::optional<std::size_t> RoomBuilder::putBeside(
    SceneObject object, std::size_t piece, const mrpt::poses::CPose3D& T_piece_obj)
{
  object.T_world_obj = scene_.objects[piece].T_world_obj + T_piece_obj;
  return put(std::move(object));
}

}  // namespace quadmap::simulator
