#include "quadmap/sensors/simulator/CameraPath.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quadmap::simulator
{
namespace
{
constexpr int kSamplesPerWaypoint = 64;
constexpr double kTurnLength = 0.9;  // turning by 1 rad takes as long as walking this far [m]

/** Catmull-Rom: through b (t = 0) and c (t = 1). */
Eigen::Vector3d interpolate(
    const Eigen::Vector3d& a,
    const Eigen::Vector3d& b,
    const Eigen::Vector3d& c,
    const Eigen::Vector3d& d,
    double t)
{
  return 0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t +
                (3 * b - a - 3 * c + d) * t * t * t);
}

/** \param s In waypoints since the first. */
Waypoint viewAt(const std::vector<Waypoint>& way, double s)
{
  const std::size_t n = way.size(), i = static_cast<std::size_t>(s);
  const auto& a = way[(i + n - 1) % n];
  const auto& b = way[i % n];
  const auto& c = way[(i + 1) % n];
  const auto& d = way[(i + 2) % n];
  const double t = s - static_cast<double>(i);
  return {
      interpolate(a.eye, b.eye, c.eye, d.eye, t),
      interpolate(a.target, b.target, c.target, d.target, t)};
}

/** Places along the way (in waypoints) at which to take the frames so that the pace is even. */
std::vector<double> evenPace(const std::vector<Waypoint>& way, int frames)
{
  const std::size_t steps = way.size() * kSamplesPerWaypoint;
  std::vector<double> effort{0};
  Waypoint last = viewAt(way, 0);
  for (std::size_t i = 1; i <= steps; ++i)
  {
    const Waypoint view = viewAt(way, static_cast<double>(i) / kSamplesPerWaypoint);
    const Eigen::Vector3d u = (last.target - last.eye).normalized();
    const Eigen::Vector3d v = (view.target - view.eye).normalized();
    const double turn = kTurnLength * std::acos(std::clamp(u.dot(v), -1.0, 1.0));
    effort.push_back(effort.back() + std::hypot((view.eye - last.eye).norm(), turn));
    last = view;
  }

  std::vector<double> places;
  for (int frame = 0; frame < frames; ++frame)
  {
    const double wanted = effort.back() * frame / frames;
    const auto next = std::upper_bound(effort.begin(), effort.end(), wanted);
    const auto i = static_cast<std::size_t>(next - effort.begin()) - 1;
    const double share = (wanted - effort[i]) / std::max(1e-12, effort[i + 1] - effort[i]);
    places.push_back((static_cast<double>(i) + share) / kSamplesPerWaypoint);
  }
  return places;
}

/** Looks along eye -> target with the horizon level, plus the movement of a walking person. */
mrpt::poses::CPose3D handHeld(const Waypoint& view, const TrajectoryOptions& options, double time)
{
  const Eigen::Vector3d forward = view.target - view.eye;
  const double phase = 2 * M_PI * options.stepRate * time;
  const double sway = mrpt::DEG2RAD(options.sway_deg);
  const double yaw = std::atan2(forward.y(), forward.x()) + 0.5 * sway * std::sin(0.31 * phase + 2);
  const double pitch = std::atan2(-forward.z(), std::hypot(forward.x(), forward.y())) +
                       sway * std::sin(0.53 * phase);
  const double roll = sway * std::sin(0.5 * phase + 1);
  const double z = view.eye.z() + options.bob * std::sin(phase);
  return {view.eye.x(), view.eye.y(), z, yaw, pitch, roll};
}

void checkFree(const Scene& scene, const mrpt::poses::CPose3D& pose, std::size_t frame)
{
  const Eigen::Vector3d p(pose.x(), pose.y(), pose.z());
  const Eigen::Vector3d& size = scene.room.size;
  const bool inside = std::abs(p.x()) < size.x() / 2 && std::abs(p.y()) < size.y() / 2 &&
                      p.z() > 0 && p.z() < size.z();
  if (!inside)
    throw std::runtime_error(mrpt::format(
        "[trajectory] frame %zu is outside the room, at (%.2f, %.2f, %.2f)", frame, p.x(), p.y(),
        p.z()));
  for (const auto& object : scene.objects)
  {
    const Ellipsoid box = object.truth();
    const Eigen::Vector3d q = box.rotation().transpose() * (p - box.center());
    if ((q.cwiseAbs() - box.semiAxes()).maxCoeff() < 0)
      throw std::runtime_error(mrpt::format(
          "[trajectory] frame %zu is inside [object %s], at (%.2f, %.2f, %.2f)", frame,
          object.name.c_str(), p.x(), p.y(), p.z()));
  }
}

}  // namespace

std::vector<mrpt::poses::CPose3D> cameraPath(const Scene& scene, const TrajectoryOptions& options)
{
  std::vector<mrpt::poses::CPose3D> path;
  for (const double place : evenPace(scene.waypoints, options.frames))
  {
    const Waypoint view = viewAt(scene.waypoints, place);
    const Eigen::Vector3d forward = view.target - view.eye;
    if (forward.head<2>().norm() < 0.05 * forward.norm() || forward.norm() < 1e-6)
      throw std::runtime_error(mrpt::format(
          "[trajectory] frame %zu looks straight up or down (eye and target too close?)",
          path.size()));
    path.push_back(handHeld(
        view, options, options.duration * static_cast<double>(path.size()) / options.frames));
    checkFree(scene, path.back(), path.size() - 1);
  }
  return path;
}

}  // namespace quadmap::simulator
