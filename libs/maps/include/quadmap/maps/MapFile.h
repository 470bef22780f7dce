#pragma once

#include <string>

#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
/** The map that a path names, whichever form it has there: a folder of quadmap-slam (its
 * objects.quadmap), a .quadmap file, or an objects.simplemap, whose boxes are mapped anew at the
 * poses that stand with them. Objects mapped anew have ids of their own.
 * \exception std::runtime_error If there is no such path, no map at it, or the file is damaged. The
 * message names the file. */
CQuadricObjectMap readMap(const std::string& path);

/** The objects.quadmap in a folder of quadmap-slam; the path itself when it is none.
 * \exception std::runtime_error If there is no such path, or no map in the folder. */
std::string mapFileOf(const std::string& path);

/** The file with the frames that the map at a path was made of: an objects.simplemap, or that
 * beside the objects.quadmap of a folder. Empty when there is none. \exception std::runtime_error
 * As mapFileOf(). */
std::string framesFileOf(const std::string& path);

/** The frames in framesFileOf() a path; empty when there is no such file. The frames are read when
 * they are asked for, and a damaged file is then a std::runtime_error that names it. */
SessionFrames framesOf(const std::string& path);

}  // namespace quadmap
