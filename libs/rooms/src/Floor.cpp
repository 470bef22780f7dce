#include "Floor.h"

#include <algorithm>
#include <cmath>

namespace quadmap::simulator
{
namespace
{
constexpr double kTouch = 1e-3;  // what touches may overlap by so much [m]

Eigen::Vector2d axisOf(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }

/** Half the width of a box along a direction. */
double reach(const UprightBox& box, const Eigen::Vector2d& direction)
{
  const Eigen::Vector2d x = axisOf(box.yaw), y(-x.y(), x.x());
  return box.half.x() * std::abs(x.dot(direction)) + box.half.y() * std::abs(y.dot(direction));
}

UprightBox boxOf(
    const mrpt::poses::CPose3D& T_world_obj,
    const Eigen::Vector3d& middle,
    const Eigen::Vector3d& half)
{
  Eigen::Vector3d center;
  T_world_obj.composePoint(middle.x(), middle.y(), middle.z(), center.x(), center.y(), center.z());
  return {
      center.head<2>(), half.head<2>(), T_world_obj.yaw(), center.z() - half.z(),
      center.z() + half.z()};
}

}  // namespace

double UprightBox::distanceTo(const Eigen::Vector2d& p) const
{
  const Eigen::Vector2d x = axisOf(yaw), d = p - center;
  const Eigen::Vector2d local(x.dot(d), x.x() * d.y() - x.y() * d.x());
  return (local.cwiseAbs() - half).cwiseMax(0.0).norm();
}

bool overlap(const UprightBox& a, const UprightBox& b, double gap)
{
  if (a.high <= b.low + kTouch || b.high <= a.low + kTouch) return false;
  const Eigen::Vector2d d = b.center - a.center;
  for (const double yaw : {a.yaw, a.yaw + M_PI / 2, b.yaw, b.yaw + M_PI / 2})
  {
    const Eigen::Vector2d axis = axisOf(yaw);
    if (std::abs(axis.dot(d)) + kTouch >= reach(a, axis) + reach(b, axis) + gap) return false;
  }
  return true;
}

UprightBox boundsOf(const SceneObject& object)
{
  const Ellipsoid truth = object.truth();
  const Eigen::Vector3d center = truth.center(), half = truth.semiAxes();
  return {
      center.head<2>(), half.head<2>(), object.T_world_obj.yaw(), center.z() - half.z(),
      center.z() + half.z()};
}

std::vector<UprightBox> partBoxes(const SceneObject& object)
{
  std::vector<UprightBox> boxes;
  for (const auto& part : object.parts)
  {
    const auto& t = part.T_obj_prim;
    const bool turnsAboutZ = std::abs(t.pitch()) + std::abs(t.roll()) == 0;
    if (turnsAboutZ)  // its own box is tighter than that along the axes of the object
    {
      UprightBox box = boxOf(object.T_world_obj, {t.x(), t.y(), t.z()}, part.halfSize);
      box.yaw += t.yaw();
      boxes.push_back(box);
    }
    else
      boxes.push_back(boxOf(object.T_world_obj, {t.x(), t.y(), t.z()}, halfExtent(part)));
  }
  return boxes;
}

bool collide(const SceneObject& a, const SceneObject& b)
{
  if (!overlap(boundsOf(a), boundsOf(b))) return false;
  const auto ofB = partBoxes(b);
  for (const auto& box : partBoxes(a))
    for (const auto& other : ofB)
      if (overlap(box, other)) return true;
  return false;
}

bool isInside(const UprightBox& box, const Room& room)
{
  const Eigen::Vector2d half = room.size.head<2>() / 2;
  for (int axis = 0; axis < 2; ++axis)
    if (std::abs(box.center[axis]) + reach(box, Eigen::Vector2d::Unit(axis)) > half[axis] + kTouch)
      return false;
  return box.low >= -kTouch && box.high <= room.size.z() + kTouch;
}

UprightBox grown(UprightBox box, double by)
{
  box.half.array() += by;
  return box;
}

}  // namespace quadmap::simulator
