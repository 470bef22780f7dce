#pragma once

#include <opencv2/core.hpp>

/** Settings that the image pyramids and the optical flow on them share. */
namespace quadmap::flow
{
constexpr int kPyramidLevels = 3;              //!< Pyramid levels above the image itself
inline cv::Size window() { return {15, 15}; }  //!< Neighbourhood of a corner that is compared [px]
}  // namespace quadmap::flow
