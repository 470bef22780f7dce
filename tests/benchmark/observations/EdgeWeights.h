#pragma once

#include <ostream>

#include "EdgeTable.h"

namespace quadmap::observations
{
/** Fits the weights of doc/mathematics.md, (9.2), and prints them beside those in use: what stands
 * in libs/perception/src/edges/HiddenPart.cpp.
 *
 * An object goes on beyond an edge when its whole outline ends farther out than what is seen of it.
 * What the detector errs by does not count, as the edge's sigma says that.
 * \param run The random rooms, scenes or seeds to fit to; each edge counts once.
 * \exception std::runtime_error If they show too few edges of a kind. */
Rows printEdgeWeights(const RunOptions& run, const EdgeTruthOptions& truth, std::ostream& out);

}  // namespace quadmap::observations
