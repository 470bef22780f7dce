#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "quadmap/base/OutputGroup.h"
#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
/** Draws each keyframe of a run with its boxes, their measurements, and the objects they were taken
 * for (see drawFrame()), as frame-000000.jpg and so on in the order of map.simplemap. One keyframe
 * is in memory at a time.
 * \param result Folder of quadmap-slam: map.simplemap, objects.simplemap and report.json are read.
 * \param objects The objects of its map.
 * \param folder Where the pictures go, in the place of earlier ones; made when missing.
 * \param group The pictures appear when it is committed.
 * \param progress Called with the share that is done, in [0, 1].
 * \return Number of pictures.
 * \exception std::runtime_error For a file that cannot be read or written; names it. */
std::size_t writeKeyframePictures(
    const std::string& result,
    const std::vector<ObjectRecord>& objects,
    const std::string& folder,
    OutputGroup& group,
    const std::function<void(double)>& progress);

}  // namespace quadmap
