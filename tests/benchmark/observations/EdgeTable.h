#pragma once

#include <ostream>

#include "SceneRun.h"

namespace quadmap::observations
{
/** When an edge of a box is invalid: the object's whole outline ends further out than what is
 * visible of it by more than this. */
struct EdgeTruthOptions
{
  double pixels = 3;    //!< Of an image 640 px wide; scaled with the width
  double share = 0.03;  //!< ... plus this share of the box's size across the edge
};

/** Prints how well the usable edges are told from those that the object goes on beyond: for each
 * rule alone and for both, in total, per kind of edge and per label (doc/benchmarks.md, "Box
 * edges"). */
void printEdgeTable(const RunOptions& run, const EdgeTruthOptions& truth, std::ostream& out);

}  // namespace quadmap::observations
