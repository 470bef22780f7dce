#pragma once

#include <string>

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
bool isSevenScenesFolder(const std::string& folder);

/** A sequence of 7-Scenes as it is downloaded: frame-XXXXXX.color.png (or .jpg), .depth.png in
 * millimetres and .pose.txt, at 30 Hz.
 * \exception std::runtime_error Names the file. */
FolderContent readSevenScenesFolder(const std::string& folder, const FrameFolderOptions& options);

}  // namespace quadmap
