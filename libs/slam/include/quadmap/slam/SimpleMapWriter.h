#pragma once

#include <string>

#include "quadmap/slam/KeyframeSpool.h"
#include "quadmap/slam/PoseNodes.h"

namespace quadmap
{
/** What a keyframe of a .simplemap contains. */
enum class SimpleMapContent
{
  Scans,   //!< The range scans, stock classes only: every MRPT program reads it
  Objects  //!< CObservationObjects
};

/** Writes an mrpt::maps::CSimpleMap with a sensory frame per node, that is one for all cameras of a
 * pose, and the observations of the spool; it is never in memory as a whole.
 * \param poses Those of the nodes.
 * \exception std::runtime_error If the file cannot be written. */
void writeSimpleMap(
    const std::string& path,
    const std::vector<PoseNode>& nodes,
    const KeyframeSpool& spool,
    SimpleMapContent content,
    const std::vector<mrpt::poses::CPose3DPDFGaussian>& poses);

}  // namespace quadmap
