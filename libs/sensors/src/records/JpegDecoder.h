#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace quadmap
{
/** An image, or why there is none. */
struct DecodedJpeg
{
  cv::Mat image;           //!< Empty when it could not be decoded
  std::string reason;      //!< Then
  bool isDamaged = false;  //!< False: TurboJPEG may just not know its form, as four inks
};

/** Whether a note of libjpeg is about damage. It fills the rest of a damaged image with grey; its
 * other notes are about things that do not change the image. */
bool tellsDamage(const std::string& note);

/** Decodes a JPEG by TurboJPEG to pixels in the order blue, green, red: the same as cv::imdecode()
 * gives, without its conversion of each pixel, and damage is told instead of printed.
 * \param rows, columns Largest size that any of its segments states.
 * \param reduction Only every so many pixels of a row and a column, 1, 2, 4 or 8; with 8 most of
 * the work is saved, and damage is still noticed. */
DecodedJpeg decodedJpeg(
    const std::uint8_t* bytes, std::size_t size, int rows, int columns, int reduction = 1);

}  // namespace quadmap
