#pragma once

#include <string>

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
bool isIclFolder(const std::string& folder);

/** A recording of ICL-NUIM, as its PNGs compatible with TUM RGB-D are downloaded: associations.txt
 * with depth first (made from the names of the images when it is missing), and perhaps a
 * trajectory *.gt.freiburg. Times are numbers of images, taken as seconds as in the trajectory.
 * \exception std::runtime_error Names file and line. */
FolderContent readIclFolder(const std::string& folder, const FrameFolderOptions& options);

}  // namespace quadmap
