#include "quadmap/surfaces/RoomPlanes.h"

#include <algorithm>
#include <cmath>

#include "quadmap/surfaces/SurfaceTolerance.h"
#include "room/RoomGeometry.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
constexpr double kWallCell = 0.10;        // size of the cells of an extent [m]
constexpr double kHorizontalCell = 0.05;  // of a horizontal one: things stand on it to its edge [m]
constexpr double kReach = 6.5;      // farther surfaces support nothing a depth camera sees [m]
constexpr unsigned kMinFrames = 3;  // that make a surface
constexpr int kMinHits = 2;         // that make a cell
constexpr int kMaxHits = 8;         // so that what was moved away is taken back soon
constexpr unsigned kMinCells = 4;   // of a wall, or of what is in reach of one frame
constexpr unsigned kMinHorizontalCells =
    48;                                // 0.12 m^2: a keyboard or a book is no surface of the room
constexpr unsigned kMinFurniture = 2;  // frames that make a surface furniture
constexpr unsigned kMaxOthers = 4;     // times as many may show it without saying so
constexpr unsigned kDoubtful = 30;     // frames that an unconfirmed surface is kept for
constexpr unsigned kMemory = 1000;     // frames after which a cell is forgotten: poses drift
constexpr double kMinGain = 0.1;       // of one frame's plane; keeps following slow drift
// The tolerance of poses, doc/mathematics.md, (5.3).
constexpr double kPoseHeight = 0.03;   // height error of a pose, two standard deviations [m]
constexpr double kPoseAngle = 0.03;    // tilt error of a pose, two standard deviations [rad]
constexpr double kFloorHeight = 0.01;  // error of heights above the floor of the frame [m]
constexpr double kFloorAngle = 0.005;  // [rad]

constexpr double kSameDirection = 0.985;  // cosine: one wall, 10 degrees
// Parts of one surface that things on it keep apart are nearer than this [cells of 0.05 m].
constexpr int kNear = 5;

/** Moves a surface up by some metres. */
void raise(SurfacePatch& patch_map, double by)
{
  patch_map.plane.d -= by * patch_map.plane.n.z();
  for (auto& p : patch_map.samples) p.z() += static_cast<float>(by);
}

double cellSize(SurfaceKind kind)
{
  return kind == SurfaceKind::Wall ? kWallCell : kHorizontalCell;
}

/** Horizontal unit vector along a wall. */
Eigen::Vector3d alongWall(const Plane& wall)
{
  return Eigen::Vector3d::UnitZ().cross(wall.n).normalized();
}

}  // namespace

RoomPlanes::Cell RoomPlanes::cellOf(const RoomSurface& surface, const Eigen::Vector3d& p_map)
{
  const auto cell = [size = cellSize(surface.kind)](double a, double b)
  { return Cell(static_cast<int>(std::floor(a / size)), static_cast<int>(std::floor(b / size))); };
  if (surface.kind == SurfaceKind::Wall)
    return cell(alongWall(surface.plane).dot(p_map), p_map.z());
  return cell(p_map.x(), p_map.y());
}

Eigen::Vector3f RoomPlanes::pointOf(const RoomSurface& surface, const Cell& cell)
{
  const double size = cellSize(surface.kind);
  const double a = (cell.first + 0.5) * size, b = (cell.second + 0.5) * size;
  Eigen::Vector3d p(a, b, -surface.plane.d);
  if (surface.kind == SurfaceKind::Wall)
    p = alongWall(surface.plane) * a + Eigen::Vector3d::UnitZ() * b -
        surface.plane.n * surface.plane.d;
  return p.cast<float>();
}

bool RoomPlanes::isNear(const RoomSurface& surface, const SurfacePatch& patch_map)
{
  const auto coarse = [](const Cell& c)
  {
    const auto index = [](int i) { return i >= 0 ? i / kNear : (i + 1) / kNear - 1; };
    return Cell(index(c.first), index(c.second));
  };
  std::vector<Cell> occupied;
  for (const auto& [cell, state] : surface.cells)
    if (const Cell c = coarse(cell); occupied.empty() || c != occupied.back())
      occupied.push_back(c);
  std::sort(occupied.begin(), occupied.end());
  const auto isOccupied = [&](const Cell& c)
  { return std::binary_search(occupied.begin(), occupied.end(), c); };
  std::optional<Cell> last;  // neighbours mostly share a cell
  for (const auto& p : patch_map.samples)
  {
    const Cell c = coarse(cellOf(surface, p.cast<double>()));
    if (c == last) continue;
    last = c;
    for (int k = 0; k < 9; ++k)
      if (isOccupied({c.first + k % 3 - 1, c.second + k / 3 - 1})) return true;
  }
  return false;
}

bool RoomPlanes::isConfirmed(const RoomSurface& surface) { return surface.frames >= kMinFrames; }

bool RoomPlanes::isFurniture(const RoomSurface& surface)
{
  return surface.furnitureFrames >= kMinFurniture &&
         kMaxOthers * surface.furnitureFrames >= surface.frames;
}

void RoomPlanes::add(const FrameSurfaces& frame, const CPose3D& T_map_sensor)
{
  ++frame_;
  sensorHeight_ = T_map_sensor.z();
  takeBack(frame, T_map_sensor);
  if (frame.contradictsFloor) voteAgainstFloor();
  const auto rise = riseToFloor(frame, T_map_sensor);
  std::vector<bool> taken(roomSurfaces_.size(), false);
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

void RoomPlanes::fuse(const SurfacePatch& patch_map, double tolerance, std::vector<bool>& taken)
{
  const bool isWall = patch_map.kind == SurfaceKind::Wall;
  RoomSurface fresh;
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

  RoomSurface* best = nullptr;
  std::size_t bestIndex = 0;
  double bestGap = tolerance;
  for (std::size_t i = 0; i < roomSurfaces_.size(); ++i)
  {
    RoomSurface& surface = roomSurfaces_[i];
    if (surface.kind != fresh.kind || surface.plane.n.dot(fresh.plane.n) < kSameDirection) continue;
    const double gap = std::abs(surface.plane.signedDistance(center));
    // Two surfaces of one frame are one of the room only when they have one height.
    if (gap >= bestGap || (i < taken.size() && taken[i] && gap > kSameHeight)) continue;
    if (!isWall && !isNear(surface, patch_map)) continue;
    best = &surface;
    bestIndex = i;
    bestGap = gap;
  }
  if (!best)
  {
    roomSurfaces_.push_back(fresh);
    best = &roomSurfaces_.back();
    bestIndex = roomSurfaces_.size() - 1;
  }
  if (taken.size() < roomSurfaces_.size()) taken.resize(roomSurfaces_.size(), false);
  taken[bestIndex] = true;

  const double gain = std::max(kMinGain, 1.0 / (best->frames + 1.0));  // (5.4)
  const double gap = best->plane.signedDistance(center);
  const Eigen::Vector3d n = ((1 - gain) * best->plane.n + gain * fresh.plane.n).normalized();
  best->plane = {n, -n.dot(center) + (1 - gain) * gap};
  if (best->lastSeen != frame_) ++best->frames;
  if (patch_map.isFurniture) ++best->furnitureFrames;
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
  constexpr double kOnSurface = 0.01;  // the samples are the surfaces' own cells [m]
  for (const auto& p_sensor : frame.seenThrough)
  {
    const Eigen::Vector3d p = transformed(p_sensor, T_map_sensor).cast<double>();
    for (auto& surface : roomSurfaces_)
    {
      if (std::abs(surface.plane.signedDistance(p)) > kOnSurface) continue;
      const auto it = surface.cells.find(cellOf(surface, p));
      if (it != surface.cells.end() && --it->second.hits <= 0) surface.cells.erase(it);
    }
  }
}

void RoomPlanes::forget()
{
  for (auto& surface : roomSurfaces_)
    if ((frame_ - surface.lastSeen) % 16 == 0)  // looking at all cells in every frame takes time
      for (auto it = surface.cells.begin(); it != surface.cells.end();)
        it = frame_ - it->second.lastSeen > kMemory ? surface.cells.erase(it) : std::next(it);
  roomSurfaces_.erase(
      std::remove_if(
          roomSurfaces_.begin(), roomSurfaces_.end(),
          [&](const RoomSurface& surface)
          {
            return surface.cells.empty() ||
                   (!isConfirmed(surface) && frame_ - surface.lastSeen > kDoubtful);
          }),
      roomSurfaces_.end());
}

std::vector<SurfacePatch> RoomPlanes::surfaces() const
{
  const auto floor = floorHeight();
  std::vector<SurfacePatch> out;
  for (const auto& surface : roomSurfaces_)
  {
    if (!isConfirmed(surface)) continue;
    if (surface.kind != SurfaceKind::Wall && floor && -surface.plane.d < *floor + kSameFloor)
      continue;
    SurfacePatch patch = {surface.kind, surface.plane, {}, isFurniture(surface)};
    for (const auto& [cell, state] : surface.cells)
      if (state.hits >= kMinHits) patch.samples.push_back(pointOf(surface, cell));
    const bool isWall = surface.kind == SurfaceKind::Wall;
    if (patch.samples.size() >= (isWall ? kMinCells : kMinHorizontalCells))
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
    SurfacePatch patch = {
        surface.kind, surface.plane.transformed(T_sensor_map), {}, surface.isFurniture};
    for (const auto& p : surface.samples)
      if ((p - sensor).norm() < kReach) patch.samples.push_back(transformed(p, T_sensor_map));
    if (patch.samples.size() >= kMinCells) out.push_back(std::move(patch));
  }
  return out;
}

}  // namespace quadmap
