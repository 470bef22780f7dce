#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace quadmap
{
/** Reads an image whole. \param flags As of cv::imread.
 *  \exception std::runtime_error If it is missing, damaged or cut. The message is one line with
 * what the decoder says; the caller adds the path. */
cv::Mat readImageFile(const std::string& path, int flags);

}  // namespace quadmap
