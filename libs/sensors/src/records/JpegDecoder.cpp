#include "records/JpegDecoder.h"

#include <turbojpeg.h>

#include <memory>

namespace quadmap
{
namespace
{
struct Destroy
{
  void operator()(void* decoder) const { tjDestroy(decoder); }
};

/** The decoder fills the rest of a damaged image with grey and warns. Its other warnings are about
 * things that do not change the image. */
bool tellsDamage(tjhandle decoder)
{
  if (tjGetErrorCode(decoder) != TJERR_WARNING) return true;
  const std::string warning = tjGetErrorStr2(decoder);
  return warning.find("Corrupt JPEG") != std::string::npos ||
         warning.find("Premature end of JPEG") != std::string::npos;
}
}  // namespace

std::pair<cv::Mat, std::string> decodedJpeg(
    const std::uint8_t* bytes, std::size_t size, int rows, int columns, int reduction)
{
  const std::unique_ptr<void, Destroy> decoder(tjInitDecompress());
  if (!decoder) return {cv::Mat(), tjGetErrorStr2(nullptr)};
  const auto length = static_cast<unsigned long>(size);
  int width = 0, height = 0, subsampling = 0, colours = 0;
  const int head =
      tjDecompressHeader3(decoder.get(), bytes, length, &width, &height, &subsampling, &colours);
  if (head != 0 && tellsDamage(decoder.get())) return {cv::Mat(), tjGetErrorStr2(decoder.get())};
  // A size beyond what was looked at before would take memory that nobody allowed.
  if (width > columns || height > rows) return {cv::Mat(), "its size is stated in two ways"};
  const tjscalingfactor scale{1, reduction};
  width = TJSCALED(width, scale);
  height = TJSCALED(height, scale);
  cv::Mat image(height, width, CV_8UC3);
  const int pixels = tjDecompress2(
      decoder.get(), bytes, length, image.data, width, static_cast<int>(image.step), height,
      TJPF_BGR, 0);
  if (pixels != 0 && tellsDamage(decoder.get())) return {cv::Mat(), tjGetErrorStr2(decoder.get())};
  return {image, ""};
}

}  // namespace quadmap
