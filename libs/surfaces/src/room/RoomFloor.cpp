#include <algorithm>
#include <cmath>

#include "quadmap/surfaces/RoomPlanes.h"
#include "room/RoomGeometry.h"

// The floor of the room: frames vote for its height (doc/mathematics.md, 5, "Surfaces of the
// room").

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
constexpr std::size_t kVoteWindow = 200;    // floor candidates that are remembered
constexpr std::size_t kMinVotes = 3;        // that make a floor
constexpr double kMinVoteShare = 0.05;      // of all remembered
constexpr double kSensorHeightRange = 1.2;  // of a carried camera within one storey [m]

}  // namespace

std::optional<double> RoomPlanes::riseToFloor(
    const FrameSurfaces& frame, const CPose3D& T_map_sensor) const
{
  const auto known = floorHeight();
  if (!known) return {};
  for (const auto& seen : frame.seen)
  {
    if (seen.kind != SurfaceKind::Floor || seen.samples.empty()) continue;
    const double rise = *known - centroidOf(transformed(seen, T_map_sensor)).z();
    if (std::abs(rise) < kSameFloor) return rise;
  }
  return {};
}

void RoomPlanes::voteForFloor(const SurfacePatch& patch_map, const CPose3D& T_map_sensor)
{
  const Plane& plane = patch_map.plane;
  if (plane.n.z() < kMinUpright) return;
  // Where it was seen; a plane without samples where it meets the vertical through the sensor.
  const Eigen::Vector3d at =
      patch_map.samples.empty() ? positionOf(T_map_sensor) : centroidOf(patch_map);
  vote({at.z() - plane.signedDistance(at) / plane.n.z(), T_map_sensor.z(), false});
}

void RoomPlanes::voteAgainstFloor()
{
  const auto known = floorHeight();
  if (!known) return;
  vote({*known, sensorHeight_, true});
  const auto left = floorHeight();
  if (!left || std::abs(*left - *known) >= kSameFloor) ++droppedFloors_;
}

void RoomPlanes::vote(const FloorVote& vote)
{
  floorVotes_.push_back(vote);
  if (floorVotes_.size() > kVoteWindow) floorVotes_.pop_front();
}

std::optional<double> RoomPlanes::floorHeight() const
{
  std::vector<double> sorted, against;
  for (const auto& vote : floorVotes_)
    if (std::abs(vote.sensorHeight - sensorHeight_) < kSensorHeightRange)
      (vote.isAgainst ? against : sorted).push_back(vote.height);
  std::sort(sorted.begin(), sorted.end());
  const auto needed = std::max(
      kMinVotes, static_cast<std::size_t>(kMinVoteShare * static_cast<double>(sorted.size())));
  for (std::size_t first = 0; first < sorted.size(); ++first)
  {
    std::size_t last = first;
    while (last < sorted.size() && sorted[last] - sorted[first] < kSameFloor) ++last;
    if (last - first < needed) continue;
    const double height = sorted[first + (last - first) / 2];
    const auto contradicted = static_cast<std::size_t>(std::count_if(
        against.begin(), against.end(),
        [&](double other) { return std::abs(other - height) < kSameFloor; }));
    if (contradicted < std::max(kMinVotes, last - first)) return height;
  }
  return {};
}

}  // namespace quadmap
