#include <mrpt/core/format.h>

#include <cstring>
#include <optional>

#include "records/RecordLayouts.h"

namespace quadmap
{
namespace
{
constexpr std::uint64_t kDepth = sizeof(std::uint16_t);

/** Leaves out the points: quadmap makes its own of the depth image, and these take up to eight
 * times its memory. */
void points(RecordCheck& c, int version)
{
  constexpr std::uint64_t kCoordinates = 3 * kFloat, kPixel = 2 * sizeof(std::uint16_t);
  const std::uint64_t n = c.bytes.number<std::uint32_t>();
  RecordCheck::require(n <= c.limits.imagePixels, "states more points than an image has pixels");
  c.bytes.skip(n * kCoordinates);
  if (version >= 8) c.bytes.skip(n * kPixel);
  const std::vector<std::uint8_t> none(sizeof(std::uint32_t), 0);
  c.bytes.replaceFrom(c.bytes.size() - none.size(), none);
}

/** Index of the first byte behind the head of an object, which has the length of the name of its
 * class in the first byte, and its version behind the name. */
std::size_t behindHead(RecordCheck& c, std::size_t begin)
{
  const std::size_t nameLength = *c.bytes.at(begin) & ~RecordCheck::kHeadMark;
  return begin + 1 + nameLength + 1;
}

std::uint32_t storedNumber(RecordCheck& c, std::size_t at)
{
  std::uint32_t value = 0;
  std::memcpy(&value, c.bytes.at(at), sizeof value);
  return value;
}

/** \return Its number of pixels. */
std::uint64_t rangeImage(RecordCheck& c)
{
  const std::uint64_t rows = c.bytes.number<std::uint32_t>();
  const std::uint64_t columns = c.bytes.number<std::uint32_t>();
  const std::uint64_t pixels = c.pixels(rows, columns);
  c.bytes.copy(pixels * kDepth);
  return pixels;
}

void pixelLabels(RecordCheck& c)
{
  constexpr std::uint32_t kMostNames = 64;  // a bit of a pixel each
  RecordCheck::require(
      c.bytes.number<std::uint8_t>() == 1, "its pixel labels are of an unknown version");
  const std::uint64_t bytesPerPixel = c.bytes.number<std::uint8_t>();
  RecordCheck::require(
      bytesPerPixel >= 1 && bytesPerPixel <= 8, "its pixel labels are of an unknown kind");
  // Three bytes are read into a number of four.
  const std::uint64_t stored = bytesPerPixel == 3 ? 4 : bytesPerPixel;
  const std::uint64_t rows = c.bytes.number<std::uint32_t>();
  const std::uint64_t columns = c.bytes.number<std::uint32_t>();
  c.bytes.copy(c.pixels(rows, columns) * stored);
  c.text();  // "std::map" and the types it maps, as MRPT writes them
  c.text();
  c.text();
  for (auto n = c.count(kMostNames, "names of pixel labels"); n > 0; --n)
  {
    c.bytes.number<std::uint32_t>();
    c.text();
  }
}

/** All layers together may have as many pixels as an image: several frames are in memory at once.
 */
void otherLayers(RecordCheck& c)
{
  std::uint64_t pixels = 0;
  for (unsigned n = c.bytes.number<std::uint8_t>(); n > 0; --n)
  {
    c.text();
    pixels += rangeImage(c);
    RecordCheck::require(
        pixels <= c.limits.imagePixels, "its layers have more pixels than an image may have");
  }
}

/** Two flags with the names of external files. */
void externalFiles(RecordCheck& c)
{
  for (int i = 0; i < 2; ++i)
  {
    c.flag();
    c.text();
  }
}

/** \return Where the number of rows of the range image is stored, with that of columns behind it;
 * nothing when there is no range image. */
std::optional<std::size_t> images(RecordCheck& c, int version)
{
  std::optional<std::size_t> sizeAt;
  const bool hasRangeImage = c.flag();
  if (version >= 9) c.bytes.copy(kFloat);
  const std::size_t begin = c.bytes.size();
  if (hasRangeImage && version >= 9)
  {
    sizeAt = begin;
    rangeImage(c);
  }
  else if (hasRangeImage)
  {
    c.matrix();
    sizeAt = behindHead(c, begin);
  }
  if (c.flag()) c.image();
  if (c.flag()) c.image();
  return sizeAt;
}

/** The camera of the range image. When it is for another size, MRPT prints a warning for each scan
 * and takes the image's size with the other camera's focal length. The scan counts as damaged
 * instead, and gets the image's size so that MRPT prints nothing.
 * \param sizeAt See images(). External images, which are empty here, are compared later. */
void rangeCamera(RecordCheck& c, const std::optional<std::size_t>& sizeAt)
{
  constexpr int kFirstKnown = 4;                            // of the versions of TCamera
  constexpr std::size_t kParameters = 13 * sizeof(double);  // before its numbers of rows, columns
  const std::size_t begin = c.bytes.size();
  if (c.objectOf("TCamera") < kFirstKnown || !sizeAt) return;
  const std::size_t rowsAt = behindHead(c, begin) + kParameters;
  const std::size_t columnsAt = rowsAt + sizeof(std::uint32_t);
  const auto columns = storedNumber(c, columnsAt), rows = storedNumber(c, rowsAt);
  const auto imageRows = storedNumber(c, *sizeAt);
  const auto imageColumns = storedNumber(c, *sizeAt + sizeof imageRows);
  if (imageRows == 0 || (columns == imageColumns && rows == imageRows)) return;
  if (c.damage.empty())
    c.damage = mrpt::format(
        "its calibration is for %ux%u images, its depth image has %ux%u", columns, rows,
        imageColumns, imageRows);
  std::memcpy(c.bytes.at(columnsAt), &imageColumns, sizeof imageColumns);
  std::memcpy(c.bytes.at(rowsAt), &imageRows, sizeof imageRows);
}
}  // namespace

void followRangeScan(RecordCheck& c, const RecordCheck::Head& head)
{
  const int version = head.version;
  c.bytes.copy(kFloat);
  c.objectOf("CPose3D");
  if (c.flag()) points(c, version);
  const auto sizeAt = images(c, version);
  rangeCamera(c, sizeAt);
  if (version >= 4)
  {
    c.objectOf("TCamera");
    c.objectOf("CPose3D");
  }
  c.bytes.copy(kFloat + kTime);
  c.text();
  if (version >= 3) externalFiles(c);
  if (version >= 5) c.flag();
  if (version >= 6) c.flag();
  if (version >= 7 && c.flag()) pixelLabels(c);
  if (version >= 10) otherLayers(c);
}

}  // namespace quadmap
