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
 * Edges: from each robot pose to the next one, with the information of the odometry, and to the
 * confirmed objects, with that of the measurements (what several cameras know is summed). What they
 * do not know, such as the yaw of a round object, has little information; an object without any
 * hangs on the first pose with next to none.
 *
 * An edge's pose is not what was measured but what the final estimate makes of it. At a minimum all
 * gradients add up to zero, and so do these, each by itself: the graph has the minimum and about
 * the curvature of the estimation, also for programs that know no robust kernels, sizes or planes.
 * The odometry and the measurements themselves are in the other files of a run.
 * \exception std::runtime_error If the file cannot be written. */
void writePoseGraph(
    const std::string& path,
    const std::vector<PoseNode>& nodes,
    const SlamResult& result,
    const KeyframeSpool& spool,
    const PoseUncertaintyOptions& uncertainty);

}  // namespace quadmap
