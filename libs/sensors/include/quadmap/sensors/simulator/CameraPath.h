#pragma once

#include <mrpt/poses/CPose3D.h>

#include <vector>

#include "quadmap/sensors/simulator/Scene.h"

namespace quadmap::simulator
{
/** T_world_robot at some instants; robot frame x forward, y left, z up. The waypoints are passed at
 * an even pace, as options.kind says; whoever walks bobs and sways. A hand-held camera is its own
 * robot frame; that of a driving robot moves on the floor.
 * \param instants In frames since the start; the whole way takes options.frames of them.
 * \exception std::runtime_error If a camera leaves the room, something is inside an object, or the
 * way looks straight up or down; names the frame. */
std::vector<mrpt::poses::CPose3D> robotPath(
    const Scene& scene, const TrajectoryOptions& options, const std::vector<double>& instants);

}  // namespace quadmap::simulator
