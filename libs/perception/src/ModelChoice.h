#pragma once

#include "ObjectCloud.h"
#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
/** How well a cuboid explains the detector's box. */
struct BoxFit
{
  double iou = 0;          // p of doc/mathematics.md
  double tolerantIoU = 0;  // the same with box edges free to move by their standard deviation
};

/** p of a measured cuboid. An object whose lower part is hidden stands on its support all the same,
 * but its box shows only what is visible; and an L-shaped thing (a chair) leaves a corner of its
 * cuboid empty: of these views the one that fits the box best counts, the last one with a malus. */
BoxFit bestFit(
    const DepthCloud& cloud,
    const Ellipsoid& cuboid,
    const ObjectCloud& object,
    const ImageBox& box,
    double edgeTolerance);

}  // namespace quadmap
