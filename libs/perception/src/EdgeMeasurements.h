#pragma once

#include <array>

#include "DepthCloud.h"
#include "quadmap/obs/ObjectMeasurement.h"

namespace quadmap
{
/** What is known of the object when its box edges are judged. */
struct EdgeContext
{
  double nearDepth = 0;          //!< Depth of the object's nearest part [m]; 0 = unknown
  std::optional<Plane> support;  //!< Its surface is no occluder; optical frame
};

/** The four box edges as tangent planes in the optical frame, with what speaks against each: near
 * the image border, or something nearer just outside (doc/mathematics.md, "Partial observation").
 */
std::array<EdgeMeasurement, 4> measureEdges(
    const DepthCloud& cloud,
    const ImageBox& box,
    const EdgeContext& context,
    const PerceptionOptions& options);

}  // namespace quadmap
