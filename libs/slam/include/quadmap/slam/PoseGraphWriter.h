#pragma once

#include <string>
#include <vector>

#include "quadmap/slam/KeyframeSpool.h"
#include "quadmap/slam/PoseNodes.h"
#include "quadmap/slam/PoseUncertainty.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Writes the graph of the run in the text format of mrpt::graphs::CNetworkOfPoses3DInf.
 *
 * Nodes: robot poses have the ids 0, 1, ... in the order of time (T_map_robot), one for all cameras
 * of a pose; object i has the id poses + i (T_map_obj). A comment line `# TIME id seconds` for each
 * image says when the robot was there: GraphOdometry reads it, others pass over it.
 * Edges: odometry between consecutive poses, and T_robot_obj of the complete measurements the map
 * took for a confirmed object; those of several cameras are one edge. What a measurement does not
 * know (a hidden side, the yaw of a round object) has little information. Partial measurements are
 * planes: no edge can hold them.
 * \exception std::runtime_error If the file cannot be written. */
void writePoseGraph(
    const std::string& path,
    const std::vector<PoseNode>& nodes,
    const SlamResult& result,
    const KeyframeSpool& spool,
    const PoseUncertaintyOptions& uncertainty);

}  // namespace quadmap
