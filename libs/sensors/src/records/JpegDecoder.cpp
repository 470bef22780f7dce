#include "records/JpegDecoder.h"

#include <turbojpeg.h>

#include <memory>
#include <optional>

namespace quadmap
{
namespace
{
struct Destroy
{
  void operator()(void* decoder) const { tjDestroy(decoder); }
};

/** What is to be said of an image that was not decoded without a note; nothing when it is whole. */
std::optional<DecodedJpeg> problemOf(tjhandle decoder)
{
  const std::string note = tjGetErrorStr2(decoder);
  const bool isWarning = tjGetErrorCode(decoder) == TJERR_WARNING;
  if (isWarning && !tellsDamage(note)) return {};
  return DecodedJpeg{cv::Mat(), note, isWarning};
}
}  // namespace

bool tellsDamage(const std::string& note)
{
  return note.find("Corrupt JPEG") != std::string::npos ||
         note.find("Premature end of JPEG") != std::string::npos;
}

DecodedJpeg decodedJpeg(
    const std::uint8_t* bytes, std::size_t size, int rows, int columns, int reduction)
{
  const std::unique_ptr<void, Destroy> decoder(tjInitDecompress());
  if (!decoder) return {cv::Mat(), tjGetErrorStr2(nullptr), false};
  const auto length = static_cast<unsigned long>(size);
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder.get(), bytes, length, &width, &height, &subsampling, &colours))
    if (const auto problem = problemOf(decoder.get())) return *problem;
  // A size beyond what was looked at before would take memory that nobody allowed.
  if (width > columns || height > rows) return {cv::Mat(), "its size is stated in two ways", true};
  const tjscalingfactor scale{1, reduction};
  width = TJSCALED(width, scale);
  height = TJSCALED(height, scale);
  cv::Mat image(height, width, CV_8UC3);
  if (tjDecompress2(
          decoder.get(), bytes, length, image.data, width, static_cast<int>(image.step), height,
          TJPF_BGR, 0))
    if (const auto problem = problemOf(decoder.get())) return *problem;
  return {image, "", false};
}

}  // namespace quadmap
