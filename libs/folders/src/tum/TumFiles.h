#pragma once

#include <string>

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
/** All functions here throw std::runtime_error with file, line and expectation. */

/** Reads calibration.yaml. fx, fy, cx, cy, width, height and depth_factor are required; world_up
 * and the distortion k1 k2 p1 p2 k3 are not. A negative fy is legal. T_color_depth and
 * depth_raw_fx, _fy, _cx, _cy are the depth camera before its images were registered. */
FolderCamera readTumCalibration(const std::string& path);

/** Adds the frames of associations.txt. When it is missing, pairs images of rgb.txt and depth.txt
 * whose times are at most `maxDelay` [s] apart, the closest pairs first. Lines that cannot be used
 * become problems of the content. \exception std::runtime_error If no frame is left. */
void readTumFrames(FolderContent& content, double maxDelay);

bool isTumFolder(const std::string& folder);

/** A recording as it is downloaded from the TUM RGB-D benchmark, or in its layout. */
FolderContent readTumFolder(const std::string& folder, const FrameFolderOptions& options);

}  // namespace quadmap
