#pragma once

#include <string>

#include "quadmap/slam/KeyframeSpool.h"
#include "quadmap/slam/PoseUncertainty.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Writes the graph of the run in the text format of mrpt::graphs::CNetworkOfPoses3DInf.
 *
 * Nodes: keyframe k has the id k (T_map_robot); object i has the id keyframes + i (T_map_obj).
 * Edges: odometry between consecutive keyframes, and T_robot_obj of every complete measurement the
 * map took for a confirmed object. What a measurement does not know (a hidden side, the yaw of a
 * round object) has little information. Partial measurements are planes: no edge can hold
 * them.
 * \exception std::runtime_error If the file cannot be written. */
void writePoseGraph(
    const std::string& path,
    const SlamResult& result,
    const KeyframeSpool& spool,
    const PoseUncertaintyOptions& uncertainty);

}  // namespace quadmap
