#pragma once

#include <string>
#include <vector>

#include "quadmap/dense/ObjectPoints.h"

namespace quadmap
{
/** Draws each proposed cuboid over the points of its object and of what is near it, as
 * FOLDER/ID_LABEL.png. The folder is made when missing.
 * \param group The pictures appear when it is committed.
 * \param room Points of everything. \param cellSize Distance of neighbouring points [m].
 * \exception std::runtime_error If a picture cannot be drawn or written. */
void writeProposalPictures(
    const std::vector<ObjectRecord>& proposals,
    const DenseCloud& room,
    double cellSize,
    const std::string& folder,
    OutputGroup& group);

}  // namespace quadmap
