#pragma once

#include <opencv2/core.hpp>

#include "quadmap/folders/FolderCamera.h"

namespace quadmap
{
/** A depth image as the colour camera would see it: doc/mathematics.md, (24.1). Each pixel goes to
 * the one at which the colour camera sees its point, where the nearest point counts.
 * \param raw 16 bits in 1 / depthFactor metres, 0 = no measurement; the result is alike.
 * \param color Without distortion; the result has its size. */
cv::Mat registeredDepth(
    const cv::Mat& raw,
    const DepthCamera& depth,
    const mrpt::img::TCamera& color,
    double depthFactor);

}  // namespace quadmap
