#pragma once

#include <string>

#include "quadmap/review/SceneContent.h"

namespace quadmap
{
/** Writes a binary PLY: the ellipsoids as triangles in the colours of their labels, and the cloud's
 * points. Complete or not at all. \exception std::runtime_error */
void writePly(const SceneContent& content, const std::string& path);

}  // namespace quadmap
