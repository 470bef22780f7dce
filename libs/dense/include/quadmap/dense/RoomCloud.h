#pragma once

#include <functional>
#include <string>

#include "quadmap/dense/DenseCloud.h"
#include "quadmap/dense/DenseOptions.h"

namespace quadmap
{
/** The cloud of everything that the keyframes of a run saw: one point per cell, the mean of all
 * that was measured there, weighted by the noise of depth. Outliers are removed, and normals point
 * to where the surface was seen from.
 * \param result Folder of quadmap-slam, whose map.simplemap is read.
 * \param progress Called with the share of the keyframes that is done, in [0, 1].
 * \exception std::runtime_error For files that cannot be read, and without PCL. */
DenseCloud fuseRoom(
    const std::string& result,
    const DenseOptions& options,
    const std::function<void(double)>& progress);

}  // namespace quadmap
