#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cloud/ObjectCloud.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/obs/ObjectMeasurement.h"
#include "quadmap/perception/HiddenPart.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
/** The box of something that returns no depth, such as a screen. */
struct BoxAtDepth
{
  ImageBox box;      // [px]
  double depth = 0;  // Of what little of it was measured, or of its surroundings [m]
};

/** What is known of the object when its box edges are judged. */
struct EdgeContext
{
  const ObjectCloud& object;          //!< May be empty
  const LabelProperties& label;       //!< How large such things usually are
  Eigen::Vector3d up;                 //!< Optical frame, unit
  double depth = 0;                   //!< Of the object [m]; 0 = unknown
  std::vector<BoxAtDepth> screens;    //!< In front they hide the object, without depth
  std::optional<ImageBox> cuboidBox;  //!< Of the object's cuboid, unclipped [px]
};

/** The edges of a box, and what they were judged by. */
struct JudgedEdges
{
  std::array<EdgeMeasurement, 4> edges;
  BoxEvidence evidence;
};

/** The four box edges as tangent planes in the sensor frame, with what speaks against each: near
 * the image border, or the object probably goes on behind something nearer (doc/mathematics.md,
 * "Edges"). */
JudgedEdges measureEdges(
    const DepthCloud& cloud,
    const ImageBox& box,
    const EdgeContext& context,
    const PerceptionOptions& options);

}  // namespace quadmap
