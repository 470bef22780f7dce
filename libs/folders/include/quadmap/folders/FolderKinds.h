#pragma once

#include <string>
#include <vector>

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
/** The kinds of folders that can be read: "tum", "icl", ... */
std::vector<std::string> folderKinds();

/** The kind of a folder, by the files it has.
 * \exception std::runtime_error If it is of none; says what those of each kind have. */
std::string kindOfFolder(const std::string& folder);

/** Reads the lists and the calibration of a recording in a folder, but no images.
 * \exception std::invalid_argument For a kind that is not known, and for options out of range.
 * \exception std::runtime_error If a file is missing or malformed; names file and line. */
FrameFolder openFrameFolder(
    const std::string& kind, const std::string& folder, const FrameFolderOptions& options = {});

}  // namespace quadmap
