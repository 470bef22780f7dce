#pragma once

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/obs/ObjectMeasurement.h"

namespace quadmap
{
/** Returns a cuboid whose faces say "at least" where the detector saw the object reach farther than
 * the cuboid does. These are the faces that look out over such an edge of the box: a part of the
 * object is missing in the cloud there, such as a headboard taken for the wall, or black legs. The
 * opposite is not corrected, as the cuboid of a chair leaves a corner of its box empty. \param
 * edgeTolerance Of an edge of the box [px]. \param complete Optical frame. */
CompleteMeasurement weakenFacesInsideBox(
    const PinholeCamera& camera,
    const ImageBox& box,
    double edgeTolerance,
    CompleteMeasurement complete);

}  // namespace quadmap
