#pragma once

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/obs/ObjectMeasurement.h"

namespace quadmap
{
/** The detector saw the object reach farther than the cuboid does: faces that look out over such an
 * edge of the box become inequalities. A part of the object is missing in the cloud then (a
 * headboard taken for the wall, black legs). Never the other way round: the cuboid of a chair
 * leaves a corner of the box empty. \param complete In the optical frame. \param edgeTolerance Of
 * an edge of the box [px]. */
void weakenFacesInsideBox(
    const PinholeCamera& camera,
    const ImageBox& box,
    double edgeTolerance,
    CompleteMeasurement& complete);

}  // namespace quadmap
