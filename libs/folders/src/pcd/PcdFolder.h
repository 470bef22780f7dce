#pragma once

#include <string>

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
bool isPcdFolder(const std::string& folder);

/** Organised clouds NAME.pcd in the frame of the camera (x right, y down, z forward), with poses
 * from NAME.txt or NAME.pose.txt (4x4), from groundtruth.txt, or from the headers. The camera
 * follows from the points themselves.
 * \exception std::runtime_error Names the file. */
FolderContent readPcdFolder(const std::string& folder, const FrameFolderOptions& options);

}  // namespace quadmap
