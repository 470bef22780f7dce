#pragma once

#include <functional>
#include <string>

#include "PointGrid.h"
#include "quadmap/dense/DenseOptions.h"
#include "quadmap/sensors/ResultKeyframes.h"

namespace quadmap
{
/** Gives the points of one image that are trusted: within range, and not between two surfaces.
 * Their weights follow from the noise of depth. \exception std::runtime_error If the scan has no
 * depth image or no usable calibration. */
void forEachPoint(
    const KeyframeScan& image,
    const DenseOptions& options,
    const std::function<void(const MeasuredPoint&)>& visit);

/** Gives the images of a run that have depth, of at most options.maxKeyframes keyframes.
 * \param progress Called with the share that is done, in [0, 1].
 * \exception std::runtime_error For files that cannot be read, and when no image has depth. Names
 * the file and the keyframe. */
void forEachDepthImage(
    const std::string& result,
    ResultKeyframes::Boxes boxes,
    const DenseOptions& options,
    const std::function<void(const KeyframeScan&)>& visit,
    const std::function<void(double)>& progress);

}  // namespace quadmap
