#pragma once

#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
/** Exact volume of the intersection of two circumscribed cuboids, arbitrarily oriented [m^3]. */
double cuboidIntersectionVolume(const Ellipsoid& a, const Ellipsoid& b);

/** Intersection over union of the two circumscribed cuboids in place, in [0, 1]. */
double cuboidIoU(const Ellipsoid& a, const Ellipsoid& b);

/** Shape IoU: IoU of two cuboids after centre and axes are aligned (doc/mathematics.md).
 * \param sizesA, sizesB Half (or full) sizes, axis i of A against axis i of B [m]. */
double alignedIoU(const Eigen::Vector3d& sizesA, const Eigen::Vector3d& sizesB);

}  // namespace quadmap
