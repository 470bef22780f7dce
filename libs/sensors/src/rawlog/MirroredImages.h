#pragma once

#include "quadmap/sensors/RgbdFrame.h"

namespace quadmap
{
/** Some recordings (ICL-NUIM) have calibrations with a negative fy: the y axis of their camera
 * points up in the image. Turning the images upside down and taking -fy gives the same points in
 * space, and is what everything downstream expects:
 *
 *   v' = rows - 1 - v,  cy' = rows - 1 - cy,  fy' = -fy,  hence (v' - cy') / fy' = (v - cy) / fy
 *
 * Changes images, boxes, masks and calibrations of the frame where fy is negative, and sets
 * isTurned. */
void makeFyPositive(RgbdFrame& frame);

}  // namespace quadmap
