#include "scene/WaypointText.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <cmath>
#include <stdexcept>

#include "scene/SceneText.h"

namespace quadmap::simulator
{
namespace
{
constexpr double kFar = 100;  // largest coordinate of a room [m]

Waypoint viewOf(const Entry& e)
{
  const auto words = wordsOf(e.text);
  if (words.size() != 6) e.reject("expected six numbers: eye x y z, target x y z");
  return {e.vector(words, 0, -kFar, kFar), e.vector(words, 3, -kFar, kFar)};
}

/** A place on the floor, and where to look if that is given. */
struct Stop
{
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // [m]
  std::optional<double> heading;                    // [rad]
};

Stop stopOf(const Entry& e)
{
  const auto words = wordsOf(e.text);
  if (words.size() != 2 && words.size() != 3) e.reject("expected: x y [heading in degrees]");
  Stop stop;
  stop.place.x() = e.number(words[0], -kFar, kFar);
  stop.place.y() = e.number(words[1], -kFar, kFar);
  if (words.size() == 3) stop.heading = mrpt::DEG2RAD(e.number(words[2], -360, 360));
  return stop;
}

/** Whether the robot moves at a stop, so that there is a way to look along. */
bool moves(const std::vector<Stop>& stops, std::size_t i)
{
  const bool before = i > 0 && stops[i].place != stops[i - 1].place;
  return before || (i + 1 < stops.size() && stops[i + 1].place != stops[i].place);
}

}  // namespace

std::vector<Waypoint> readWaypoints(const mrpt::config::CConfigFileBase& config, Motion kind)
{
  const auto entries = numberedEntries(config, "trajectory", "waypoint");
  const std::size_t fewest = kind == Motion::Walk ? 4 : 2;
  if (entries.size() < fewest)
    throw std::invalid_argument(
        mrpt::format("[trajectory] needs waypoint1 to waypoint%zu at least", fewest));

  std::vector<Waypoint> way;
  std::vector<Stop> stops;
  for (const auto& e : entries)
    if (kind == Motion::Drive)
      stops.push_back(stopOf(e));
    else
      way.push_back(viewOf(e));
  for (std::size_t i = 0; i < stops.size(); ++i)
  {
    if (!stops[i].heading && !moves(stops, i))
      entries[i].reject("where to look is not clear: give x y heading");
    Waypoint stop{stops[i].place, stops[i].place};
    if (const auto heading = stops[i].heading)
      stop.target += Eigen::Vector3d(std::cos(*heading), std::sin(*heading), 0);
    way.push_back(stop);
  }
  return way;
}

}  // namespace quadmap::simulator
