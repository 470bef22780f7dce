#pragma once

#include <string>
#include <vector>

#include "quadmap/obs/DetectedObject.h"
#include "quadmap/sensors/TumDataset.h"

namespace quadmap
{
/** All functions here throw std::runtime_error with file, line and expectation. */

/** Reads calibration.yaml. fx, fy, cx, cy, width, height and depth_factor are required; world_up
 * and the distortion k1 k2 p1 p2 k3 are not. A negative fy is legal. */
TumCalibration readTumCalibration(const std::string& path);

/** Reads associations.txt of the folder. When it is missing, pairs images of rgb.txt and depth.txt
 * whose times are at most `maxDelay` [s] apart, the closest pairs first. */
std::vector<TumFrame> readTumFrames(const std::string& folder, double maxDelay);

/** Reads boxes, one `class_id class_name score x1 y1 x2 y2` per line. */
std::vector<DetectedObject> readDetections(const std::string& path);

}  // namespace quadmap
