#pragma once

#include <optional>

#include "quadmap/geometry/Projection.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/obs/ObjectMeasurement.h"
#include "quadmap/surfaces/WallDistance.h"

namespace quadmap
{
/** The cuboid of a screen, of which depth shows a part of the front only: the rectangle on the
 * plane of this front whose outline is the box (doc/mathematics.md, 10, "Screens"). It is as thick
 * as its kind usually is. Only its front says something; the edges of the box tell the rest. \param
 * cuboid Of the part with depth, optical frame. \return Nothing when its front was not seen as a
 * surface, or no rectangle has this outline. */
std::optional<CompleteMeasurement> screenInBox(
    const PinholeCamera& camera,
    const ImageBox& box,
    const LabelProperties& label,
    const CompleteMeasurement& cuboid);

/** The cuboid of what hangs on a wall too flat to stand out from it: the rectangle before the wall
 * whose outline is the box. Its front and its back say something; the edges of the box tell the
 * rest. \param up Unit vector, optical frame, as the result. */
std::optional<CompleteMeasurement> plateInBox(
    const PinholeCamera& camera,
    const ImageBox& box,
    const WallDistance& onWall,
    const Eigen::Vector3d& up,
    const PerceptionOptions& options);

}  // namespace quadmap
