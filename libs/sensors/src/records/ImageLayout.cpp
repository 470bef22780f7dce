#include <mrpt/core/format.h>

#include <opencv2/imgcodecs.hpp>

#include "quadmap/base/ErrorText.h"
#include "quadmap/sensors/EncodedImage.h"
#include "records/RecordLayouts.h"

namespace quadmap
{
namespace
{
/** The version that MRPT 2.5.8 writes. Since version 8 negative sizes mean plain pixels. */
constexpr std::uint8_t kVersionOfPixels = 9;

void append(std::vector<std::uint8_t>& to, std::int32_t number)
{
  for (int byte = 0; byte < 4; ++byte)
    to.push_back(static_cast<std::uint8_t>(static_cast<std::uint32_t>(number) >> (8 * byte)));
}

/** Bytes per pixel and channel, of MRPT's number for them. */
std::uint64_t bytesOfDepth(int depth)
{
  constexpr std::uint64_t kBytes[] = {1, 1, 2, 2, 4, 4, 8};
  RecordCheck::require(depth >= 0 && depth < 7, "holds an image of an unknown kind of pixels");
  return kBytes[depth];
}

/** MRPT reads as many bytes as the file says, whatever the size of the image is. */
void grayImage(RecordCheck& c, int version)
{
  const auto width = c.bytes.number<std::uint32_t>();
  const auto height = c.bytes.number<std::uint32_t>();
  c.bytes.number<std::int32_t>();
  const auto stated = c.bytes.number<std::uint32_t>();
  const int depth = version >= 9 ? c.bytes.number<std::int32_t>() : 0;
  RecordCheck::require(
      c.pixels(height, width) * bytesOfDepth(depth) == stated,
      "holds an image whose size in pixels and bytes differ");
  const bool isZip = c.flag();
  RecordCheck::require(!isZip, "holds an image of a compression that MRPT no longer reads");
  c.bytes.copy(stated);
}

/** Decodes the JPEG that follows. The image is empty where nobody needs its pixels, and when it is
 * damaged. */
cv::Mat decodedJpeg(RecordCheck& c)
{
  const auto size = c.bytes.number<std::uint32_t>();
  if (!c.needsPixels)
  {
    c.bytes.skip(size);
    return {};
  }
  const std::size_t begin = c.bytes.size();
  c.bytes.copy(size);
  try
  {
    return decodeImage(c.bytes.at(begin), size, cv::IMREAD_COLOR, c.limits.imagePixels);
  }
  catch (const std::exception& e)
  {
    if (c.damage.empty()) c.damage = rootMessage(e);
    return {};
  }
}

/** Puts the pixels of the JPEG that follows in place of what begins at `from`. */
void replaceJpeg(RecordCheck& c, const RecordCheck::Head& head, std::size_t from)
{
  const cv::Mat pixels = decodedJpeg(c);
  std::vector<std::uint8_t> plain;
  const std::size_t rowBytes = static_cast<std::size_t>(pixels.cols) * 3;
  plain.reserve(8 + rowBytes * static_cast<std::size_t>(pixels.rows));
  append(plain, -pixels.cols);
  append(plain, -pixels.rows);
  for (int row = 0; row < pixels.rows; ++row)
    plain.insert(plain.end(), pixels.ptr(row), pixels.ptr(row) + rowBytes);
  c.bytes.replaceFrom(from, plain);
  *c.bytes.at(head.versionAt) = kVersionOfPixels;
}

void colourImage(RecordCheck& c, const RecordCheck::Head& head)
{
  const std::size_t from = c.bytes.size();
  if (head.version < 7) return replaceJpeg(c, head, from);
  const std::int64_t width = c.bytes.number<std::int32_t>();
  const std::int64_t height = c.bytes.number<std::int32_t>();
  if (width > 0 && height > 0) return replaceJpeg(c, head, from);
  RecordCheck::require(
      (width < 0 && height < 0) || (width == 0 && height == 0),
      mrpt::format("holds an image of %dx%d pixels", int(width), int(height)));
  constexpr std::uint64_t kChannels = 3;
  c.bytes.copy(
      c.pixels(static_cast<std::uint64_t>(-height), static_cast<std::uint64_t>(-width)) *
      kChannels);
}
}  // namespace

void followImage(RecordCheck& c, const RecordCheck::Head& head)
{
  const bool isExternal = c.flag();
  if (isExternal) return c.text();
  const bool hasColour = c.flag();
  if (hasColour)
    colourImage(c, head);
  else
    grayImage(c, head.version);
}

}  // namespace quadmap
