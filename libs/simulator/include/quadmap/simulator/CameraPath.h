#pragma once

#include <mrpt/poses/CPose3D.h>

#include <vector>

#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
/** T_world_robot at some instants. The frame of the robot is x forward, y left, z up. The way
 * passes the waypoints at an even speed, in the manner of options.kind; a walking person bobs and
 * sways. The frame of a camera held in the hands is that of the robot. A driving robot's is on the
 * floor. \param instants Frames since the start. The whole way takes options.frames of them.
 * \exception std::runtime_error If a camera leaves the room or is inside an object, or looks
 * straight up or down. The message names the frame. */
std::vector<mrpt::poses::CPose3D> robotPath(
    const Scene& scene, const TrajectoryOptions& options, const std::vector<double>& instants);

}  // namespace quadmap::simulator
