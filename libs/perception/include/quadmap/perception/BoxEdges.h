#pragma once

#include <array>

#include "quadmap/geometry/Projection.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** From the edge of a box to the border of the image that it faces [px]. */
double distanceToBorder(const PinholeCamera& camera, const ImageBox& box, BoxEdge edge);

/** The four edges of a box as tangent planes in the sensor frame, as far as the image alone tells:
 * those near its border are cut, and nothing hides the others. */
std::array<EdgeMeasurement, 4> edgesWithoutDepth(
    const PinholeCamera& camera, const ImageBox& box, const PerceptionOptions& options);

/** Measures every box of an image by its edges alone, as methods without depth do.
 * \exception std::runtime_error If the boxes have no usable calibration. */
void measureWithoutDepth(CObservationObjects& boxes, const PerceptionOptions& options);

}  // namespace quadmap
