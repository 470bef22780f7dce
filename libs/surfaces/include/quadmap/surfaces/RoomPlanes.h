#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "quadmap/surfaces/SurfacePatch.h"

namespace quadmap
{
/** The flat surfaces of a z-up map: the floor, table tops and the like, and walls, each with where
 * it was seen. Every frame adds what it shows and takes back what it looks through, so that a
 * support is known although the present frame does not show it; what was left behind is forgotten
 * (doc/mathematics.md). */
class RoomPlanes
{
 public:
  /** What a frame showed. \param T_map_sensor Pose of its sensor. */
  void add(const FrameSurfaces& frame, const mrpt::poses::CPose3D& T_map_sensor);

  /** The floor and the confirmed surfaces within the reach of a sensor, in its frame. */
  std::vector<SurfacePatch> around(const mrpt::poses::CPose3D& T_map_sensor) const;

  /** z of the floor in the map [m]: of the surfaces that recent frames of this storey took for the
   * floor, the lowest that several agree on and fewer contradict. Nothing at first. */
  std::optional<double> floorHeight() const;

  /** How often the floor was given up because frames contradicted it. */
  std::size_t droppedFloors() const { return droppedFloors_; }

  /** Confirmed surfaces in the map, without the floor. */
  std::vector<SurfacePatch> surfaces() const;

 private:
  using Cell = std::pair<int, int>;
  struct CellState
  {
    int hits = 0;
    std::uint32_t lastSeen = 0;  // number of the frame
  };
  struct RoomSurface
  {
    SurfaceKind kind = SurfaceKind::Horizontal;
    Plane plane;                   // in the map
    unsigned frames = 0;           // that showed it
    unsigned furnitureFrames = 0;  // ... as furniture
    std::uint32_t lastSeen = 0;
    std::map<Cell, CellState> cells;
  };
  struct FloorVote
  {
    double height = 0, sensorHeight = 0;  // in the map [m]
    bool isAgainst = false;               // the frame looked below this height
  };

  void voteForFloor(const SurfacePatch& patch_map, const mrpt::poses::CPose3D& T_map_sensor);
  void voteAgainstFloor();
  void vote(const FloorVote& vote);
  /** By how much a frame's heights are too low, by the floor it shows: heights above that are as
   * good as the sensor, those in the map only as good as the pose. Nothing without a floor [m]. */
  std::optional<double> riseToFloor(
      const FrameSurfaces& frame, const mrpt::poses::CPose3D& T_map_sensor) const;
  void fuse(const SurfacePatch& patch_map, double tolerance, std::vector<bool>& taken);
  void takeBack(const FrameSurfaces& frame, const mrpt::poses::CPose3D& T_map_sensor);
  void forget();
  static bool isNear(const RoomSurface& surface, const SurfacePatch& patch_map);
  static bool isConfirmed(const RoomSurface& surface);
  static bool isFurniture(const RoomSurface& surface);
  static Cell cellOf(const RoomSurface& surface, const Eigen::Vector3d& p_map);
  static Eigen::Vector3f pointOf(const RoomSurface& surface, const Cell& cell);

  std::uint32_t frame_ = 0;
  std::vector<RoomSurface> roomSurfaces_;
  std::deque<FloorVote> floorVotes_;
  double sensorHeight_ = 0;  // of the latest frame [m]
  std::size_t droppedFloors_ = 0;
};

}  // namespace quadmap
