#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cv
{
class Mat;
}

namespace quadmap
{
/** [px] */
struct ImageSize
{
  unsigned width = 0, height = 0;
};

/** Decodes a JPEG or PNG file that is in memory. They state their size, which is looked at before
 * memory is taken for the pixels.
 * \param flags Of cv::imdecode(). The orientation in EXIF data is ignored in any case.
 * \exception std::runtime_error If it has another format, is damaged, or has more
 * pixels than that. */
cv::Mat decodeImage(
    const std::uint8_t* bytes, std::size_t size, int flags, std::uint64_t mostPixels);

/** The same for a file. \exception std::runtime_error The message does not name the file. */
cv::Mat decodeImageFile(const std::string& path, int flags, std::uint64_t mostPixels);

/** The bytes of an image file. \exception std::runtime_error The message does not name the file. */
std::vector<std::uint8_t> readImageFile(const std::string& path);

/** The size of a JPEG in colour, after a look at whether all of it can be decoded; nothing for
 * other images. \exception std::runtime_error If it is damaged or has more pixels than that. */
std::optional<ImageSize> sizeOfColorJpeg(
    const std::vector<std::uint8_t>& bytes, std::uint64_t mostPixels);

}  // namespace quadmap
