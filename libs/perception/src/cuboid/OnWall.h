#pragma once

#include "cuboid/FaceEstimator.h"
#include "quadmap/surfaces/WallDistance.h"

namespace quadmap
{
/** Puts the back of what hangs on a wall there: nobody sees it, and everybody sees the wall. The
 * front is as far before the wall as what the box shows (doc/mathematics.md, 8, "On a wall").
 * Nothing is done when no face of the cuboid is parallel to the wall. */
void endAtWall(
    const WallDistance& onWall,
    const FaceEstimator& estimator,
    const PerceptionOptions& options,
    Faces& faces);

}  // namespace quadmap
