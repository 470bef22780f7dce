#pragma once

#include <string>

#include "quadmap/review/SceneContent.h"

namespace quadmap
{
/** Writes a binary PLY file with the points of the cloud, and with the ellipsoids as triangles in
 * the colours of their labels. Vertices have the id of their object, -1 in the cloud, and the
 * header has a comment `object ID LABEL` for each. The file appears complete or not at all.
 * \exception std::runtime_error If it cannot be written. */
void writePly(const SceneContent& content, const std::string& path);

}  // namespace quadmap
