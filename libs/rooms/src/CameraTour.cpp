#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "FreeFloor.h"
#include "FurnitureKit.h"
#include "RoomSteps.h"

namespace quadmap::simulator
{
namespace
{
constexpr double kMargin = 0.3;          // half the width of who walks [m]
constexpr double kHeadroom = 1.9;        // who walks is so tall [m]
constexpr double kLeastFloor = 5;        // smallest free floor worth a walk [m^2]
constexpr double kLeastSeen = 0.9;       // share of the things that are looked at from two places
constexpr double kLeastEffort = 20;      // of the way, turns included [m]
constexpr double kStep = 0.45;           // between waypoints [m]
constexpr double kTourTurnLength = 0.9;  // turning by 1 rad takes as long as walking this far [m]

using Places = std::vector<std::size_t>;

/** Places far from each other, the first at random. */
Places spreadPlaces(const FreeFloor& floor, FurnitureKit& kit, std::size_t count)
{
  const auto& at = floor.places();
  Places chosen{kit.pick(at.size())};
  while (chosen.size() < count)
  {
    std::size_t farthest = 0;
    double best = -1;
    for (std::size_t i = 0; i < at.size(); ++i)
    {
      double near = std::numeric_limits<double>::infinity();
      for (const auto j : chosen) near = std::min(near, (at[i] - at[j]).norm());
      if (near > best) best = near, farthest = i;
    }
    chosen.push_back(farthest);
  }
  return chosen;
}

/** The places in an order that makes the round trip short: two ways that cross are swapped. */
Places shortTour(const FreeFloor& floor, Places stops)
{
  const auto n = stops.size();
  const auto leg = [&](std::size_t a, std::size_t b)
  { return static_cast<double>(floor.way(stops[a], stops[b]).size()); };
  std::vector<std::vector<double>> length(n, std::vector<double>(n, 0));
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < a; ++b) length[a][b] = length[b][a] = leg(a, b);
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  for (bool better = true; better;)
  {
    better = false;
    for (std::size_t i = 0; i + 2 < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j)
      {
        const auto a = order[i], b = order[i + 1], c = order[j], d = order[(j + 1) % n];
        if (length[a][c] + length[b][d] >= length[a][b] + length[c][d] - 1e-9) continue;
        std::reverse(
            order.begin() + static_cast<std::ptrdiff_t>(i) + 1,
            order.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        better = true;
      }
  }
  Places tour;
  for (const auto i : order) tour.push_back(stops[i]);
  return tour;
}

/** Points of the closed way through the places, about a step apart. */
std::vector<Eigen::Vector2d> stepsOf(const FreeFloor& floor, const Places& tour)
{
  std::vector<Eigen::Vector2d> steps;
  double since = kStep;
  for (std::size_t i = 0; i < tour.size(); ++i)
  {
    const auto way = floor.way(tour[i], tour[(i + 1) % tour.size()]);
    for (std::size_t k = 0; k + 1 < way.size(); ++k)
    {
      const Eigen::Vector2d p = floor.places()[way[k]];
      if (since >= kStep) steps.push_back(p), since = 0;
      since += (floor.places()[way[k + 1]] - p).norm();
    }
  }
  for (int round = 0; round < 2; ++round)  // rounds the corners where there is room
  {
    const auto before = steps;
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
      const Eigen::Vector2d& a = before[(i + steps.size() - 1) % steps.size()];
      const Eigen::Vector2d smooth = 0.5 * before[i] + 0.25 * (a + before[(i + 1) % steps.size()]);
      if (floor.isFree(smooth)) steps[i] = smooth;
    }
  }
  return steps;
}

/** Chooses where to look from each step of a way: at what was seen least, without haste. */
class Gaze
{
 public:
  Gaze(const Scene& scene, FurnitureKit& kit) : kit_(kit)
  {
    for (const auto& object : scene.objects)
      if (!object.label.empty())
      {
        const Ellipsoid truth = object.truth();
        things_.push_back({truth.center(), truth.semiAxes().norm(), 0});
      }
  }

  /** The point to look at. It is 2 m away, so that the camera turns evenly between two steps. */
  Eigen::Vector3d from(const Eigen::Vector3d& eye)
  {
    double best = -1, direction = 0;
    for (int k = 0; k < kDirections; ++k)
    {
      const double yaw = 2 * M_PI * k / kDirections;
      const double turn = last_ ? std::abs(mrpt::math::wrapToPi(yaw - *last_)) : 0;
      if (turn > kMostTurn) continue;
      double value = 0.01;
      for (const auto& thing : things_) value += interest(thing, eye, yaw);
      value /= 1 + turn / kMostTurn;
      if (value > best) best = value, direction = yaw;
    }
    last_ = direction;
    Eigen::Vector2d heights(0, 0);  // sum of weight times slope, sum of weights
    for (auto& thing : things_)
    {
      const double weight = interest(thing, eye, direction);
      if (weight <= 0) continue;
      const Eigen::Vector3d d = thing.center - eye;
      heights += weight * Eigen::Vector2d(d.z() / d.head<2>().norm(), 1);
      thing.seen += 1;
    }
    const double slope = heights.y() > 0 ? std::clamp(heights.x() / heights.y(), -0.9, 0.3) : -0.3;
    const double yaw = direction + kit_.gaussian(0.05);
    return eye + 2.0 * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), slope);
  }

  /** Share of the things that were looked at from at least two steps. */
  double shareSeen() const
  {
    const auto seen = std::count_if(
        things_.begin(), things_.end(), [](const Thing& thing) { return thing.seen >= 2; });
    return static_cast<double>(seen) /
           static_cast<double>(std::max<std::size_t>(1, things_.size()));
  }

 private:
  struct Thing
  {
    Eigen::Vector3d center;
    double radius;  // [m]
    double seen;    // number of steps from which it was looked at
  };

  static constexpr int kDirections = 36;
  static constexpr double kMostTurn = mrpt::DEG2RAD(55.0);
  static constexpr double kHalfView = mrpt::DEG2RAD(22.0);

  /** What looking at a thing is worth. Small things must be near. */
  static double interest(const Thing& thing, const Eigen::Vector3d& eye, double yaw)
  {
    const Eigen::Vector3d d = thing.center - eye;
    const double distance = d.head<2>().norm();
    const double farthest = thing.radius < 0.25 ? 2.6 : 4.0;
    const double nearest = std::max(0.7, 1.1 * thing.radius);
    if (distance < nearest || distance > farthest) return 0;
    const double off = std::abs(mrpt::math::wrapToPi(std::atan2(d.y(), d.x()) - yaw));
    return off > kHalfView ? 0 : 1 / (1 + thing.seen);
  }

  FurnitureKit& kit_;
  std::vector<Thing> things_;
  std::optional<double> last_;
};

/** Adds the waypoints of one round. \return Its length and turns, as a length [m]. */
double walkRound(
    std::vector<Waypoint>& waypoints,
    const std::vector<Eigen::Vector2d>& steps,
    double eyeLevel,
    Gaze& gaze)
{
  double effort = 0;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const double z = eyeLevel + 0.08 * std::sin(2 * M_PI * static_cast<double>(i) / 9);
    const Eigen::Vector3d eye(steps[i].x(), steps[i].y(), z);
    const Eigen::Vector3d target = gaze.from(eye);
    if (!waypoints.empty())
    {
      const auto& last = waypoints.back();
      const Eigen::Vector3d before = (last.target - last.eye).normalized();
      const double cosine = before.dot((target - eye).normalized());
      const double turn = std::acos(std::clamp(cosine, -1.0, 1.0));
      effort += std::hypot((eye - last.eye).norm(), kTourTurnLength * turn);
    }
    waypoints.push_back({eye.unaryExpr(&inMillimetres), target.unaryExpr(&inMillimetres)});
  }
  return effort;
}

}  // namespace

bool planTour(Scene& scene, FurnitureKit& kit)
{
  const FreeFloor floor(scene, kMargin, kHeadroom);
  if (floor.area() < kLeastFloor) return false;
  const auto stops = static_cast<std::size_t>(std::clamp(floor.area() / 1.2, 5.0, 9.0));
  const auto steps = stepsOf(floor, shortTour(floor, spreadPlaces(floor, kit, stops)));
  if (steps.size() < 8) return false;
  Gaze gaze(scene, kit);
  const double eyeLevel = kit.between(1.2, 1.6);
  scene.waypoints.clear();
  double effort = 0;
  while (effort < kLeastEffort)  // a short round is walked again, looking at what was seen least
    effort += walkRound(scene.waypoints, steps, eyeLevel, gaze);
  if (gaze.shareSeen() < kLeastSeen) return false;
  auto& trajectory = scene.options.trajectory;
  trajectory.frames = static_cast<int>(std::clamp(effort / 0.12, 150.0, 250.0));
  trajectory.duration = std::round(effort / kit.between(0.45, 0.65));
  trajectory.sway_deg = inMillimetres(kit.between(0.6, 2.0));
  return true;
}

}  // namespace quadmap::simulator
