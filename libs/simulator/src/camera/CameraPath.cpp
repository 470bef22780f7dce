#include "quadmap/simulator/CameraPath.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <memory>
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

/** Where to be and what to look at, anywhere along a way. Places are counted in waypoints since the
 * first. */
class Way
{
 public:
  explicit Way(const std::vector<Waypoint>& waypoints) : way_(waypoints) {}
  virtual ~Way() = default;
  virtual std::size_t length() const { return way_.size() - 1; }
  virtual Waypoint viewAt(double s) const = 0;

 protected:
  /** The segment of a place on an open way. */
  std::size_t segmentOf(double s) const
  {
    return std::min(static_cast<std::size_t>(s), way_.size() - 2);
  }

  const std::vector<Waypoint>& way_;
};

/** Smooth and closed. */
class Walk : public Way
{
 public:
  using Way::Way;
  std::size_t length() const override { return way_.size(); }
  Waypoint viewAt(double s) const override
  {
    const std::size_t n = way_.size(), i = static_cast<std::size_t>(s);
    const auto& a = way_[(i + n - 1) % n];
    const auto& b = way_[i % n];
    const auto& c = way_[(i + 1) % n];
    const auto& d = way_[(i + 2) % n];
    const double t = s - static_cast<double>(i);
    return {
        interpolate(a.eye, b.eye, c.eye, d.eye, t),
        interpolate(a.target, b.target, c.target, d.target, t)};
  }
};

/** Straight from waypoint to waypoint. */
class Approach : public Way
{
 public:
  using Way::Way;
  Waypoint viewAt(double s) const override
  {
    const std::size_t i = segmentOf(s);
    const double t = s - static_cast<double>(i);
    return {
        (1 - t) * way_[i].eye + t * way_[i + 1].eye,
        (1 - t) * way_[i].target + t * way_[i + 1].target};
  }
};

/** Smooth on the floor; turns on the spot where two waypoints are at one place. */
class Drive : public Way
{
 public:
  explicit Drive(const std::vector<Waypoint>& waypoints) : Way(waypoints)
  {
    for (std::size_t i = 0; i < way_.size(); ++i)
    {
      const Eigen::Vector3d ahead = isFree(i) ? directionAt(i) : way_[i].target - way_[i].eye;
      const double heading = std::atan2(ahead.y(), ahead.x());
      headings_.push_back(
          i == 0 ? heading : headings_[i - 1] + mrpt::math::wrapToPi(heading - headings_[i - 1]));
    }
  }

  Waypoint viewAt(double s) const override
  {
    const std::size_t i = segmentOf(s);
    const double t = s - static_cast<double>(i), rest = 1 - t;
    // Hermite's cubic does not overshoot with tangents as long as the step.
    const Eigen::Vector3d d = step(i);
    const Eigen::Vector3d a = d.norm() * directionAt(i), b = d.norm() * directionAt(i + 1);
    const Eigen::Vector3d eye =
        way_[i].eye + t * t * (3 - 2 * t) * d + t * rest * (rest * a - t * b);
    const Eigen::Vector3d along = 6 * t * rest * d + rest * (1 - 3 * t) * a - t * (2 - 3 * t) * b;
    if (isFree(i) && isFree(i + 1) && !along.isZero()) return {eye, eye + along};
    const double heading = rest * headings_[i] + t * headings_[i + 1];
    return {eye, eye + Eigen::Vector3d(std::cos(heading), std::sin(heading), 0)};
  }

 private:
  /** Whether the robot looks where it goes. */
  bool isFree(std::size_t i) const { return way_[i].target == way_[i].eye; }

  Eigen::Vector3d step(std::size_t segment) const
  {
    return way_[segment + 1].eye - way_[segment].eye;
  }

  /** Direction of the way at a waypoint, midway between the steps before and after it. */
  Eigen::Vector3d directionAt(std::size_t i) const
  {
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    if (i > 0) direction += step(i - 1);
    if (i + 1 < way_.size()) direction += step(i);
    return direction.normalized();
  }

  std::vector<double> headings_;  // [rad], without jumps
};

std::unique_ptr<Way> wayOf(const Scene& scene, Motion kind)
{
  if (kind == Motion::Drive) return std::make_unique<Drive>(scene.waypoints);
  if (kind == Motion::Approach) return std::make_unique<Approach>(scene.waypoints);
  return std::make_unique<Walk>(scene.waypoints);
}

/** Parameters of the way at some instants, such that the speed is even. */
std::vector<double> evenPace(
    const Way& way, const TrajectoryOptions& options, const std::vector<double>& at)
{
  const bool closed = options.kind == Motion::Walk;
  const int frames = options.frames, rounds = options.rounds;
  const std::size_t steps = way.length() * kSamplesPerWaypoint;
  std::vector<double> effort{0};
  Waypoint last = way.viewAt(0);
  for (std::size_t i = 1; i <= steps; ++i)
  {
    const Waypoint view = way.viewAt(static_cast<double>(i) / kSamplesPerWaypoint);
    const Eigen::Vector3d u = (last.target - last.eye).normalized();
    const Eigen::Vector3d v = (view.target - view.eye).normalized();
    const double turn = kTurnLength * std::acos(std::clamp(u.dot(v), -1.0, 1.0));
    effort.push_back(effort.back() + std::hypot((view.eye - last.eye).norm(), turn));
    last = view;
  }

  std::vector<double> places;
  for (const double instant : at)
  {
    // An open way ends with the last frame.
    const double wanted = closed ? effort.back() * std::fmod(instant * rounds, frames) / frames
                                 : effort.back() * std::min(1.0, instant / (frames - 1));
    const auto next = std::upper_bound(effort.begin(), effort.end(), wanted);
    const auto i = std::min(static_cast<std::size_t>(next - effort.begin()), steps) - 1;
    const double share = (wanted - effort[i]) / std::max(1e-12, effort[i + 1] - effort[i]);
    places.push_back((static_cast<double>(i) + share) / kSamplesPerWaypoint);
  }
  return places;
}

/** Pose of a camera at the eye that looks to the target, with a horizontal horizon and the movement
 * of a walking person. */
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

/** One instant of the way. */
struct Moment
{
  double frame;  // frames since the start
  double time;   // time since the start [s]
};

/** Checks that p, and what is below it, is inside the room and outside all objects.
 * \param below The space below p that must be free [m]. */
void checkFree(const Scene& scene, const Eigen::Vector3d& p, double below, const Moment& moment)
{
  const Eigen::Vector3d& size = scene.room.size;
  const bool inside = std::abs(p.x()) < size.x() / 2 && std::abs(p.y()) < size.y() / 2 &&
                      p.z() > 0 && p.z() < size.z();
  if (!inside)
    throw std::runtime_error(mrpt::format(
        "[trajectory] frame %g is outside the room, at (%.2f, %.2f, %.2f)", moment.frame, p.x(),
        p.y(), p.z()));
  for (const auto& object : scene.objects)
  {
    if (!object.standsAt(moment.time)) continue;
    SceneObject there = object;
    there.T_world_obj = object.poseAt(moment.time);
    const Ellipsoid box = there.truth();
    const Eigen::Vector3d q = box.rotation().transpose() * (p - box.center());
    const Eigen::Vector3d reach = box.semiAxes() + Eigen::Vector3d(0, 0, below);
    const bool beside = std::abs(q.x()) > reach.x() || std::abs(q.y()) > reach.y();
    if (!beside && q.z() < reach.z() && q.z() > -box.semiAxes().z())
      throw std::runtime_error(mrpt::format(
          "[trajectory] frame %g is inside [object %s], at (%.2f, %.2f, %.2f)", moment.frame,
          object.name.c_str(), p.x(), p.y(), p.z()));
  }
}

void checkCameras(
    const Scene& scene,
    const mrpt::poses::CPose3D& T_world_robot,
    Motion kind,
    const Moment& moment)
{
  double top = 0;
  for (const auto& camera : scene.options.cameras())
  {
    const auto p = (T_world_robot + camera.T_robot_camera()).translation();
    checkFree(scene, {p.x, p.y, p.z}, 0, moment);
    top = std::max(top, p.z);
  }
  if (kind == Motion::Drive)
    checkFree(scene, {T_world_robot.x(), T_world_robot.y(), top}, top, moment);
}

}  // namespace

std::vector<mrpt::poses::CPose3D> robotPath(
    const Scene& scene, const TrajectoryOptions& options, const std::vector<double>& instants)
{
  const auto way = wayOf(scene, options.kind);
  TrajectoryOptions motion = options;
  if (options.kind == Motion::Drive) motion.bob = motion.sway_deg = 0;
  const auto places = evenPace(*way, options, instants);

  std::vector<mrpt::poses::CPose3D> path;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const Waypoint view = way->viewAt(places[i]);
    const Eigen::Vector3d forward = view.target - view.eye;
    if (forward.head<2>().norm() < 0.05 * forward.norm() || forward.norm() < 1e-6)
      throw std::runtime_error(mrpt::format(
          "[trajectory] frame %g looks straight up or down (eye and target too close?)",
          instants[i]));
    const double time = options.duration * instants[i] / options.frames;
    path.push_back(handHeld(view, motion, time));
    checkCameras(scene, path.back(), options.kind, {instants[i], time});
  }
  return path;
}

}  // namespace quadmap::simulator
