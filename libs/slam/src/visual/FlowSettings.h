#pragma once

#include <opencv2/core.hpp>

/** What the pyramids and the optical flow on them must agree on. */
namespace quadmap::flow
{
constexpr int kLevels = 3;  //!< Coarser ones [-]: a corner may move by half its neighbourhood
inline cv::Size window() { return {15, 15}; }  //!< Compared around a corner [px]
}  // namespace quadmap::flow
