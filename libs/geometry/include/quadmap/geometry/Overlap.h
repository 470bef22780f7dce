#pragma once

#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
/** Exact volume that the circumscribed cuboids of two objects share, in any orientation [m^3]. */
double cuboidIntersectionVolume(const Ellipsoid& a, const Ellipsoid& b);

/** Intersection over union of the two circumscribed cuboids where they are, in [0, 1]:
 * doc/mathematics.md, (20.6). */
double cuboidIoU(const Ellipsoid& a, const Ellipsoid& b);

/** Shape: intersection over union of two cuboids with centres and axes aligned, in [0, 1]:
 * doc/mathematics.md, (20.5).
 * \param sizesA, sizesB Half sizes or full sizes; axis i of A is compared with axis i of B [m]. */
double alignedIoU(const Eigen::Vector3d& sizesA, const Eigen::Vector3d& sizesB);

}  // namespace quadmap
