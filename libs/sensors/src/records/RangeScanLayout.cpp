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

void images(RecordCheck& c, int version)
{
  const bool hasRangeImage = c.flag();
  if (version >= 9) c.bytes.copy(kFloat);
  if (hasRangeImage && version >= 9) rangeImage(c);
  if (hasRangeImage && version < 9) c.matrix();
  if (c.flag()) c.image();
  if (c.flag()) c.image();
}
}  // namespace

void followRangeScan(RecordCheck& c, const RecordCheck::Head& head)
{
  const int version = head.version;
  c.bytes.copy(kFloat);
  c.objectOf("CPose3D");
  if (c.flag()) points(c, version);
  images(c, version);
  c.objectOf("TCamera");
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
