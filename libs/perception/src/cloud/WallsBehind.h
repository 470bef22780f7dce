#pragma once

#include <optional>

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

/** A wall and how well its direction is known. */
struct FittedWall
{
  Plane plane;              //!< Optical frame, normal towards the camera
  double headingSigma = 0;  //!< [rad]
};

/** The vertical plane that more of what is around a box lies on than on others, as far as pairs of
 * points show, also where the segmentation found none. \return Nothing when too little does. */
std::optional<FittedWall> wallAround(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    const PerceptionOptions& options);

}  // namespace quadmap
