#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <vector>

#include "quadmap/sensors/simulator/Scene.h"

namespace quadmap::simulator
{
/** The keys waypointN of section [trajectory], in the order of N: `eye x y z target x y z`, and of
 * a robot that drives `x y [heading_deg]`. Without a heading it looks where it goes, and of two
 * stops at one place the first looks along the way that it came, the second where it goes on: it
 * turns. \exception std::invalid_argument For too few and for what is no waypoint. */
std::vector<Waypoint> readWaypoints(const mrpt::config::CConfigFileBase& config, Motion kind);

}  // namespace quadmap::simulator
