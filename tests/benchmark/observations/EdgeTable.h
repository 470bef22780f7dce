#pragma once

#include <array>
#include <ostream>

#include "ObservationJson.h"
#include "SceneRun.h"

namespace quadmap::observations
{
/** When an edge of a box is invalid: the object goes on beyond it, so that the plane through it is
 * not tangent to the object. */
struct EdgeTruthOptions
{
  /** From the measured edge outwards to the edge of the object's whole outline [px of an image 640
   * px wide]: what a bad detector errs by is less, what something hides is usually more. */
  double beyond = 18;
};

/** How much further out than a box an outline ends at each edge, in the order of BoxEdge [px]. */
std::array<double, 4> pixelsBeyond(const ImageBox& box, const ImageBox& outline);

/** Prints how well the usable edges are told from those that the object goes on beyond: for each
 * rule alone and for both, in total and per kind of edge (doc/benchmarks.md, "Box edges").
 * \param perLabel Rows for each label too. */
Rows printEdgeTable(
    const RunOptions& run, const EdgeTruthOptions& truth, bool perLabel, std::ostream& out);

}  // namespace quadmap::observations
