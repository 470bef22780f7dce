#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <vector>

#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
/** Reads the keys waypointN of section [trajectory], in the order of N: `eye x y z target x y z`
 * or, for a robot that drives, `x y [heading_deg]`. Without a heading the robot looks where it
 * goes. Of two stops at one place the first looks along the way that leads there and the second
 * along the way that leads on, so that the robot turns. \exception std::invalid_argument For too
 * few waypoints and for texts that are none. */
std::vector<Waypoint> readWaypoints(const mrpt::config::CConfigFileBase& config, Motion kind);

}  // namespace quadmap::simulator
