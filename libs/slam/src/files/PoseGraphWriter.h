#pragma once

#include <string>
#include <vector>

#include "keyframes/KeyframeSpool.h"
#include "quadmap/odometry/PoseUncertainty.h"
#include "quadmap/slam/PoseNodes.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Writes the graph of the run in the text format of mrpt::graphs::CNetworkOfPoses3DInf.
 *
 * Nodes. Poses of the robot have the ids 0, 1, ... in the order of time (T_map_robot), one for all
 * cameras of a pose. Object i has the id poses + i (T_map_obj). A comment line `# TIME id seconds`
 * for each image says when the robot was there. GraphOdometry reads it; other programs ignore it.
 *
 * Edges. They lead from each pose to the next one, with the information of the odometry, and to the
 * confirmed objects, with that of the measurements, summed over the cameras. What is not known,
 * such as the yaw of a round object, has little information. An object without any information is
 * tied to the first pose with practically none.
 *
 * The pose of an edge is not the measured one but follows from the final estimate. At the minimum
 * of the estimation all gradients add up to zero. In this graph each of them is zero by itself. It
 * has therefore the same minimum and about the same curvature, also for programs without robust
 * kernels, sizes or planes. The odometry and the measurements are in the other files of a run.
 * \exception std::runtime_error If the file cannot be written. */
void writePoseGraph(
    const std::string& path,
    const std::vector<PoseNode>& nodes,
    const SlamResult& result,
    const KeyframeSpool& spool,
    const PoseUncertaintyOptions& uncertainty);

}  // namespace quadmap
