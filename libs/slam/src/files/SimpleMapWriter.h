#pragma once

#include <string>

#include "keyframes/KeyframeSpool.h"
#include "quadmap/slam/PoseNodes.h"

namespace quadmap
{
/** What a keyframe of a .simplemap contains. */
enum class SimpleMapContent
{
  Scans,   //!< Range scans: stock classes, which every MRPT program reads
  Objects  //!< CObservationObjects
};

/** Writes an mrpt::maps::CSimpleMap with one sensory frame per node, which has the observations of
 * all cameras of a pose. They come from the spool, and the map is never in memory as a whole.
 * \param poses Poses of the nodes.
 * \exception std::runtime_error If the file cannot be written. */
void writeSimpleMap(
    const std::string& path,
    const std::vector<PoseNode>& nodes,
    const KeyframeSpool& spool,
    SimpleMapContent content,
    const std::vector<mrpt::poses::CPose3DPDFGaussian>& poses);

}  // namespace quadmap
