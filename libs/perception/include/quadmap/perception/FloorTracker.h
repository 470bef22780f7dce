#pragma once

#include <mrpt/poses/CPose3D.h>

#include <deque>
#include <optional>

#include "quadmap/geometry/Plane.h"

namespace quadmap
{
/** Height of the floor in a z-up map, re-estimated with every frame: of the horizontal surfaces
 * that recent frames took for the floor, the lowest that several agree on. A table top that filled
 * one image, or the floor of a storey left behind, is outvoted or forgotten. */
class FloorTracker
{
 public:
  /** What a frame took for the floor. \param T_map_sensor Pose of its sensor. */
  void add(const Plane& candidate_sensor, const mrpt::poses::CPose3D& T_map_sensor);

  std::optional<double> height() const;  //!< z of the floor in the map [m]; nothing at first

  /** The floor in a sensor's frame, normal up. */
  std::optional<Plane> inSensor(const mrpt::poses::CPose3D& T_map_sensor) const;

 private:
  std::deque<double> heights_;  // of the latest candidates [m]
};

}  // namespace quadmap
