#pragma once

#include <functional>
#include <string>
#include <vector>

#include "quadmap/dense/DenseOptions.h"
#include "quadmap/evaluation/SelfCheck.h"
#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
/** Compares the objects of a map with the depth images of its keyframes, without any truth:
 * doc/mathematics.md, (22.4) and (22.5).
 * \param result Folder of quadmap-slam. \param objects The objects of its map.
 * \param progress Called with the share that is done, in [0, 1].
 * \exception std::runtime_error For files that cannot be read, and without PCL. */
SelfCheck checkAgainstDepth(
    const std::string& result,
    const std::vector<ObjectRecord>& objects,
    const DenseOptions& options,
    const std::function<void(double)>& progress);

}  // namespace quadmap
