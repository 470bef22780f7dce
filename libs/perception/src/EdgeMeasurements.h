#pragma once

#include <array>
#include <vector>

#include "DepthCloud.h"
#include "ObjectCloud.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/obs/ObjectMeasurement.h"

namespace quadmap
{
/** A box of the frame and the depth of what it shows. */
struct BoxAtDepth
{
  ImageBox box;      // [px]
  double depth = 0;  // Of its near part [m]; 0 = unknown
};

/** What is known of the object when its box edges are judged. */
struct EdgeContext
{
  const ObjectCloud& object;      //!< May be empty
  const LabelProperties& label;   //!< How large such things usually are
  Eigen::Vector3d up;             //!< Optical frame, unit
  double depth = 0;               //!< Of the object [m]; 0 = unknown
  std::vector<Plane> surfaces;    //!< Support and floor are no occluders; optical frame
  std::vector<BoxAtDepth> boxes;  //!< Of the frame: a screen in front returns no depth
};

/** The four box edges as tangent planes in the sensor frame, with what speaks against each: near
 * the image border, or the object probably goes on behind something nearer (doc/mathematics.md,
 * "Edges"). */
std::array<EdgeMeasurement, 4> measureEdges(
    const DepthCloud& cloud,
    const ImageBox& box,
    const EdgeContext& context,
    const PerceptionOptions& options);

}  // namespace quadmap
