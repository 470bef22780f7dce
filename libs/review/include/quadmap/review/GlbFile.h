#pragma once

#include <string>

#include "quadmap/review/SceneContent.h"

namespace quadmap
{
/** Writes a binary glTF 2.0 file (.glb). The node "map" turns the z-up map into glTF's y-up; below
 * it, in metres, each object is a node with its id as the name, an ellipsoid in the colour of its
 * label and, as a child "ID cuboid", the edges of its cuboid. `extras` has the label. The nodes
 * "cloud", "trajectory" and "odometry" follow where they are not empty. The file appears complete
 * or not at all. \exception std::runtime_error If it cannot be written. */
void writeGlb(const SceneContent& content, const std::string& path);

}  // namespace quadmap
