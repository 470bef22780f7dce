#pragma once

#include <set>
#include <string>

namespace quadmap::cli
{
/** The names of what quadmap-slam writes into its folder. */
inline const std::set<std::string>& resultFiles()
{
  static const std::set<std::string> names{"map.simplemap",    "objects.json",
                                           "objects.quadmap",  "objects.simplemap",
                                           "pose-graph.graph", "report.html",
                                           "report.json",      "scene.3Dscene",
                                           "trajectory.tum",   "trajectory_odometry.tum"};
  return names;
}

}  // namespace quadmap::cli
