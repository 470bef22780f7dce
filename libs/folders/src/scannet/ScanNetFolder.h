#pragma once

#include <string>

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
bool isScanNetFolder(const std::string& folder);

/** A scene in the layout in which ScanNet's recordings are unpacked: color/N.jpg, depth/N.png in
 * millimetres, pose/N.txt and the folder intrinsic/, at 30 Hz. The colour images are larger than
 * the depth images, and come out in the size of these. \exception std::runtime_error Names the
 * file. */
FolderContent readScanNetFolder(const std::string& folder, const FrameFolderOptions& options);

}  // namespace quadmap
