#pragma once

#include <mrpt/poses/CPose3D.h>

#include <vector>

#include "quadmap/sensors/simulator/Scene.h"

namespace quadmap::simulator
{
/** T_world_camera for each frame; camera frame x forward, y left, z up. A closed Catmull-Rom curve
 * through the waypoints' eyes and targets, walked at an even pace, with the bobbing and swaying of
 * somebody who walks with the camera in his hands.
 * \exception std::runtime_error If the way leaves the room, enters an object, or looks straight up
 * or down; names the frame. */
std::vector<mrpt::poses::CPose3D> cameraPath(const Scene& scene, const TrajectoryOptions& options);

}  // namespace quadmap::simulator
