#include "quadmap/perception/FloorTracker.h"

#include <algorithm>
#include <vector>

namespace quadmap
{
namespace
{
constexpr std::size_t kWindow = 200;  // candidates that are remembered
constexpr std::size_t kMinVotes = 3;  // that make a floor
constexpr double kMinShare = 0.05;    // of all remembered, so that old storeys fade
constexpr double kSameHeight = 0.10;  // [m]; pose noise and slope over a room

/** The floor's height under the sensor: where the plane meets the vertical through it. */
std::optional<double> heightBelow(const Plane& plane_map, const mrpt::poses::CPose3D& T_map_sensor)
{
  if (plane_map.n.z() < 0.9) return {};
  const double xy = plane_map.n.x() * T_map_sensor.x() + plane_map.n.y() * T_map_sensor.y();
  return -(xy + plane_map.d) / plane_map.n.z();
}

}  // namespace

void FloorTracker::add(const Plane& candidate_sensor, const mrpt::poses::CPose3D& T_map_sensor)
{
  const auto z = heightBelow(candidate_sensor.transformed(T_map_sensor), T_map_sensor);
  if (!z) return;
  heights_.push_back(*z);
  if (heights_.size() > kWindow) heights_.pop_front();
}

std::optional<double> FloorTracker::height() const
{
  std::vector<double> sorted(heights_.begin(), heights_.end());
  std::sort(sorted.begin(), sorted.end());
  const auto needed =
      std::max(kMinVotes, static_cast<std::size_t>(kMinShare * static_cast<double>(sorted.size())));
  for (std::size_t first = 0; first < sorted.size(); ++first)
  {
    std::size_t last = first;
    while (last < sorted.size() && sorted[last] - sorted[first] < kSameHeight) ++last;
    if (last - first >= needed) return sorted[first + (last - first) / 2];
  }
  return {};
}

std::optional<Plane> FloorTracker::inSensor(const mrpt::poses::CPose3D& T_map_sensor) const
{
  const auto z = height();
  if (!z) return {};
  return Plane{Eigen::Vector3d::UnitZ(), -*z}.transformed(-T_map_sensor);
}

}  // namespace quadmap
