#pragma once

#include "cloud/ObjectCloud.h"
#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
/** How well a cuboid explains the detector's box. */
struct BoxFit
{
  double iou = 0;          // p of doc/mathematics.md
  double tolerantIoU = 0;  // the same with box edges free to move by their tolerance
  bool isSpanned = false;  // the cloud reaches about as far as the box
};

/** Compares three shapes with the box and returns the best fit, equation (10.1): the cuboid, its
 * visible part, and the outline of the cloud. The visible part counts because the box of an object
 * whose lower part is hidden shows only what is visible. The outline counts, less a malus, because
 * an L-shaped thing (a chair) leaves a corner of its cuboid empty. */
BoxFit bestFit(
    const DepthCloud& cloud,
    const Ellipsoid& cuboid,
    const ObjectCloud& object,
    const ImageBox& box,
    double edgeTolerance);

}  // namespace quadmap
