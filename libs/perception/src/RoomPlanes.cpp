#include "quadmap/perception/RoomPlanes.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
constexpr double kWallCell = 0.10;       // size of the cells of an extent [m]
constexpr double kLevelCell = 0.05;      // of a horizontal one: things stand on it to its edge [m]
constexpr double kReach = 6.5;           // farther surfaces support nothing a depth camera sees [m]
constexpr unsigned kMinFrames = 3;       // that make a surface
constexpr int kMinHits = 2;              // that make a cell
constexpr int kMaxHits = 8;              // so that what was moved away is taken back soon
constexpr unsigned kMinCells = 4;        // of a wall, or of what is in reach of one frame
constexpr unsigned kMinLevelCells = 48;  // 0.12 m^2: a keyboard or a book is no surface of the room
constexpr unsigned kDoubtful = 30;       // frames that an unconfirmed surface is kept for
constexpr unsigned kMemory = 1000;       // frames after which a cell is forgotten: poses drift
constexpr double kMinGain = 0.1;         // of one frame's plane; keeps following slow drift
constexpr double kPoseHeight = 0.03;     // height error of a pose, two standard deviations [m]
constexpr double kPoseAngle = 0.03;      // tilt error of a pose, two standard deviations [rad]
constexpr double kFloorHeight = 0.01;    // error of heights above the floor of the frame [m]
constexpr double kFloorAngle = 0.005;    // [rad]

constexpr std::size_t kVoteWindow = 200;    // floor candidates that are remembered
constexpr std::size_t kMinVotes = 3;        // that make a floor
constexpr double kMinVoteShare = 0.05;      // of all remembered
constexpr double kSameFloor = 0.10;         // [m]; pose noise and slope over a room
constexpr double kSensorHeightRange = 1.2;  // of a carried camera within one storey [m]
constexpr double kMinUpright = 0.95;        // cosine: horizontal surfaces
constexpr double kSameDirection = 0.985;    // cosine: one wall, 10 degrees
constexpr int kNear = 5;  // level cells; parts of a surface that things on it keep apart: 0.25 m
constexpr double kQuarterTurn = 1.57079632679489661923;

Eigen::Vector3d positionOf(const CPose3D& pose) { return {pose.x(), pose.y(), pose.z()}; }

Eigen::Vector3d centroidOf(const SurfacePatch& patch)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : patch.samples) sum += p.cast<double>();
  return sum / static_cast<double>(patch.samples.size());
}

/** Moves a surface up. */
void raise(SurfacePatch& patch_map, double by)
{
  patch_map.plane.d -= by * patch_map.plane.n.z();
  for (auto& p : patch_map.samples) p.z() += static_cast<float>(by);
}

double cellSize(SurfaceKind kind) { return kind == SurfaceKind::Wall ? kWallCell : kLevelCell; }

/** Horizontal unit vector along a wall. */
Eigen::Vector3d alongWall(const Plane& wall)
{
  return Eigen::Vector3d::UnitZ().cross(wall.n).normalized();
}

}  // namespace

RoomPlanes::Cell RoomPlanes::cellOf(const Track& track, const Eigen::Vector3d& p_map)
{
  const auto cell = [size = cellSize(track.kind)](double a, double b)
  { return Cell(static_cast<int>(std::floor(a / size)), static_cast<int>(std::floor(b / size))); };
  if (track.kind == SurfaceKind::Wall) return cell(alongWall(track.plane).dot(p_map), p_map.z());
  return cell(p_map.x(), p_map.y());
}

Eigen::Vector3f RoomPlanes::pointOf(const Track& track, const Cell& cell)
{
  const double size = cellSize(track.kind);
  const double a = (cell.first + 0.5) * size, b = (cell.second + 0.5) * size;
  Eigen::Vector3d p(a, b, -track.plane.d);
  if (track.kind == SurfaceKind::Wall)
    p = alongWall(track.plane) * a + Eigen::Vector3d::UnitZ() * b - track.plane.n * track.plane.d;
  return p.cast<float>();
}

bool RoomPlanes::isNear(const Track& track, const SurfacePatch& patch_map)
{
  const auto coarse = [](const Cell& c)
  {
    const auto index = [](int i) { return i >= 0 ? i / kNear : (i + 1) / kNear - 1; };
    return Cell(index(c.first), index(c.second));
  };
  std::vector<Cell> occupied;
  for (const auto& [cell, state] : track.cells)
    if (const Cell c = coarse(cell); occupied.empty() || c != occupied.back())
      occupied.push_back(c);
  std::sort(occupied.begin(), occupied.end());
  const auto isOccupied = [&](const Cell& c)
  { return std::binary_search(occupied.begin(), occupied.end(), c); };
  std::optional<Cell> last;  // neighbours mostly share a cell
  for (const auto& p : patch_map.samples)
  {
    const Cell c = coarse(cellOf(track, p.cast<double>()));
    if (c == last) continue;
    last = c;
    for (int k = 0; k < 9; ++k)
      if (isOccupied({c.first + k % 3 - 1, c.second + k / 3 - 1})) return true;
  }
  return false;
}

bool RoomPlanes::isConfirmed(const Track& track) { return track.frames >= kMinFrames; }

void RoomPlanes::add(const FrameSurfaces& frame, const CPose3D& T_map_sensor)
{
  ++frame_;
  sensorHeight_ = T_map_sensor.z();
  takeBack(frame, T_map_sensor);
  const auto rise = riseToFloor(frame, T_map_sensor);
  std::vector<bool> taken(tracks_.size(), false);
  for (const auto& seen : frame.seen)
  {
    SurfacePatch patch = transformed(seen, T_map_sensor);
    if (patch.kind == SurfaceKind::Floor) voteForFloor(patch, T_map_sensor);
    if (patch.samples.empty()) continue;
    const double range = (centroidOf(patch) - positionOf(T_map_sensor)).norm();
    double tolerance = kPoseHeight + kPoseAngle * range;
    if (rise && patch.kind != SurfaceKind::Wall)
    {
      raise(patch, *rise);
      tolerance = kFloorHeight + kFloorAngle * range;
    }
    fuse(patch, tolerance, taken);
  }
  forget();
}

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
  floorVotes_.push_back({at.z() - plane.signedDistance(at) / plane.n.z(), T_map_sensor.z()});
  if (floorVotes_.size() > kVoteWindow) floorVotes_.pop_front();
}

std::optional<double> RoomPlanes::floorHeight() const
{
  std::vector<double> sorted;
  for (const auto& vote : floorVotes_)
    if (std::abs(vote.sensorHeight - sensorHeight_) < kSensorHeightRange)
      sorted.push_back(vote.height);
  std::sort(sorted.begin(), sorted.end());
  const auto needed = std::max(
      kMinVotes, static_cast<std::size_t>(kMinVoteShare * static_cast<double>(sorted.size())));
  for (std::size_t first = 0; first < sorted.size(); ++first)
  {
    std::size_t last = first;
    while (last < sorted.size() && sorted[last] - sorted[first] < kSameFloor) ++last;
    if (last - first >= needed) return sorted[first + (last - first) / 2];
  }
  return {};
}

void RoomPlanes::fuse(const SurfacePatch& patch_map, double tolerance, std::vector<bool>& taken)
{
  const bool isWall = patch_map.kind == SurfaceKind::Wall;
  Track fresh;
  fresh.kind = isWall ? SurfaceKind::Wall : SurfaceKind::Horizontal;
  const Eigen::Vector3d center = centroidOf(patch_map);
  Eigen::Vector3d normal = patch_map.plane.n;
  if (isWall)
    normal.z() = 0;
  else if (normal.z() < kMinUpright)
    return;
  else
    normal = Eigen::Vector3d::UnitZ();
  if (normal.norm() < 0.5) return;
  fresh.plane = Plane::throughPoint(normal.normalized(), center);

  Track* best = nullptr;
  std::size_t bestIndex = 0;
  double bestGap = tolerance;
  for (std::size_t i = 0; i < tracks_.size(); ++i)
  {
    Track& track = tracks_[i];
    if (track.kind != fresh.kind || track.plane.n.dot(fresh.plane.n) < kSameDirection) continue;
    const double gap = std::abs(track.plane.signedDistance(center));
    // Two surfaces of one frame are one of the room only when they are level to the millimetre
    // the sensor has: a book's cover is not the table under it.
    constexpr double kLevel = 0.02;
    if (gap >= bestGap || (i < taken.size() && taken[i] && gap > kLevel)) continue;
    if (!isWall && !isNear(track, patch_map)) continue;
    best = &track;
    bestIndex = i;
    bestGap = gap;
  }
  if (!best)
  {
    tracks_.push_back(fresh);
    best = &tracks_.back();
    bestIndex = tracks_.size() - 1;
  }
  if (taken.size() < tracks_.size()) taken.resize(tracks_.size(), false);
  taken[bestIndex] = true;

  const double gain = std::max(kMinGain, 1.0 / (best->frames + 1.0));
  const double gap = best->plane.signedDistance(center);
  const Eigen::Vector3d n = ((1 - gain) * best->plane.n + gain * fresh.plane.n).normalized();
  best->plane = {n, -n.dot(center) + (1 - gain) * gap};
  if (best->lastSeen != frame_) ++best->frames;
  best->lastSeen = frame_;
  for (const auto& p : patch_map.samples)
  {
    CellState& cell = best->cells[cellOf(*best, p.cast<double>())];
    if (cell.lastSeen != frame_) cell.hits = std::min(kMaxHits, cell.hits + 1);
    cell.lastSeen = frame_;
  }
}

void RoomPlanes::takeBack(const FrameSurfaces& frame, const CPose3D& T_map_sensor)
{
  constexpr double kOnTrack = 0.01;  // the samples are the tracks' own cells [m]
  for (const auto& p_sensor : frame.seenThrough)
  {
    const Eigen::Vector3d p = transformed(p_sensor, T_map_sensor).cast<double>();
    for (auto& track : tracks_)
    {
      if (std::abs(track.plane.signedDistance(p)) > kOnTrack) continue;
      const auto it = track.cells.find(cellOf(track, p));
      if (it != track.cells.end() && --it->second.hits <= 0) track.cells.erase(it);
    }
  }
}

void RoomPlanes::forget()
{
  for (auto& track : tracks_)
    if ((frame_ - track.lastSeen) % 16 == 0)  // looking at all cells in every frame takes time
      for (auto it = track.cells.begin(); it != track.cells.end();)
        it = frame_ - it->second.lastSeen > kMemory ? track.cells.erase(it) : std::next(it);
  tracks_.erase(
      std::remove_if(
          tracks_.begin(), tracks_.end(),
          [&](const Track& track) {
            return track.cells.empty() ||
                   (!isConfirmed(track) && frame_ - track.lastSeen > kDoubtful);
          }),
      tracks_.end());
}

std::vector<SurfacePatch> RoomPlanes::surfaces() const
{
  const auto floor = floorHeight();
  std::vector<SurfacePatch> out;
  for (const auto& track : tracks_)
  {
    if (!isConfirmed(track)) continue;
    if (track.kind != SurfaceKind::Wall && floor && -track.plane.d < *floor + kSameFloor) continue;
    SurfacePatch patch = {track.kind, track.plane, {}};
    for (const auto& [cell, state] : track.cells)
      if (state.hits >= kMinHits) patch.samples.push_back(pointOf(track, cell));
    const bool isWall = track.kind == SurfaceKind::Wall;
    if (patch.samples.size() >= (isWall ? kMinCells : kMinLevelCells))
      out.push_back(std::move(patch));
  }
  return out;
}

std::vector<SurfacePatch> RoomPlanes::around(const CPose3D& T_map_sensor) const
{
  const CPose3D T_sensor_map = -T_map_sensor;
  const Eigen::Vector3f sensor = positionOf(T_map_sensor).cast<float>();
  std::vector<SurfacePatch> out;
  if (const auto floor = floorHeight())
    out.push_back({
        SurfaceKind::Floor,
        Plane{Eigen::Vector3d::UnitZ(), -*floor}
        .transformed(T_sensor_map),
        {         }
    });
  for (const auto& surface : surfaces())
  {
    SurfacePatch patch = {surface.kind, surface.plane.transformed(T_sensor_map), {}};
    for (const auto& p : surface.samples)
      if ((p - sensor).norm() < kReach) patch.samples.push_back(transformed(p, T_sensor_map));
    if (patch.samples.size() >= kMinCells) out.push_back(std::move(patch));
  }
  return out;
}

std::optional<double> RoomPlanes::wallHeading() const
{
  // Four times the angle: walls a quarter turn apart agree.
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& track : tracks_)
  {
    if (track.kind != SurfaceKind::Wall || !isConfirmed(track)) continue;
    const double angle = 4 * std::atan2(track.plane.n.y(), track.plane.n.x());
    sum +=
        static_cast<double>(track.cells.size()) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  if (sum.norm() < kMinCells) return {};
  const double heading = std::atan2(sum.y(), sum.x()) / 4;
  return heading < 0 ? heading + kQuarterTurn : heading;
}

}  // namespace quadmap
