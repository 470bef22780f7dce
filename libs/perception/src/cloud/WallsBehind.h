#pragma once

#include "cloud/BoxCandidates.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** Takes away what of a box's candidates lies on the walls behind it: those of the segmentation,
 * and one that only the surroundings show. \param box Enlarged [px]. */
void dropWallsBehind(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    const PerceptionOptions& options,
    BoxCandidates& candidates);

}  // namespace quadmap
