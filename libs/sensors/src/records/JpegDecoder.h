#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

namespace quadmap
{
/** Decodes a JPEG by TurboJPEG to pixels in the order blue, green, red: the same as cv::imdecode()
 * gives, without its conversion of each pixel, and damage is told instead of printed.
 * \param rows, columns Largest size that any of its segments states.
 * \param reduction Only every so many pixels of a row and a column, 1, 2, 4 or 8; with 8 most of
 * the work is saved, and damage is still noticed. \return The image, empty when it is damaged, and
 * then the reason. */
std::pair<cv::Mat, std::string> decodedJpeg(
    const std::uint8_t* bytes, std::size_t size, int rows, int columns, int reduction = 1);

}  // namespace quadmap
