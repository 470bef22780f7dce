#include "quadmap/sensors/EncodedImage.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <utility>

#include "quadmap/base/ErrorText.h"
#include "quadmap/base/StderrCapture.h"
#include "quadmap/sensors/CheckedReader.h"
#include "records/JpegDecoder.h"

namespace quadmap
{
namespace
{
/** Most bytes of an image file; no image of the sizes that are read has more. */
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 28;
/** Most passes of a progressive JPEG. Encoders use about ten; thousands take minutes to decode. */
constexpr int kMostScans = 100;

struct StatedSize
{
  std::uint64_t width = 0, height = 0;
  unsigned bits = 0, channels = 0;  // of the last segment of a JPEG that states them
};

unsigned bigEndian16(const std::uint8_t* p) { return (unsigned{p[0]} << 8) | p[1]; }

std::uint64_t bigEndian32(const std::uint8_t* p)
{
  return (std::uint64_t{bigEndian16(p)} << 16) | bigEndian16(p + 2);
}

bool isStartOfFrame(unsigned marker)
{
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/** Walks the segments of a JPEG: the mark 0xFF, the kind, two bytes of length, the content. Behind
 * the head of a scan its data follow, which are passed by to the next mark.
 * \return The largest size that any segment states. */
StatedSize sizeOfJpeg(const std::uint8_t* bytes, std::size_t size)
{
  constexpr unsigned kScan = 0xDA, kFirstPlain = 0xD0, kLastPlain = 0xD9, kFrameHead = 9;
  StatedSize largest;
  int scans = 0;
  for (std::size_t at = 2; at + 4 <= size;)
  {
    const auto* mark = static_cast<const std::uint8_t*>(std::memchr(bytes + at, 0xFF, size - at));
    if (!mark) break;
    at = static_cast<std::size_t>(mark - bytes) + 1;
    if (at + 3 > size) break;
    const unsigned kind = bytes[at];
    if (kind == 0xFF || kind <= 1 || (kind >= kFirstPlain && kind <= kLastPlain)) continue;
    if (isStartOfFrame(kind) && at + kFrameHead <= size)
    {
      largest.height = std::max<std::uint64_t>(largest.height, bigEndian16(bytes + at + 4));
      largest.width = std::max<std::uint64_t>(largest.width, bigEndian16(bytes + at + 6));
      largest.bits = bytes[at + 3];
      largest.channels = bytes[at + 8];
    }
    if (kind == kScan && ++scans > kMostScans)
      throw std::runtime_error(mrpt::format("is a JPEG of more than %d passes", kMostScans));
    at += 1 + bigEndian16(bytes + at + 1);
  }
  return largest;
}

bool isJpeg(const std::uint8_t* bytes, std::size_t size)
{
  return size >= 2 && bytes[0] == 0xFF && bytes[1] == 0xD8;
}

/** Zero when the image has another format or does not tell. */
StatedSize statedSize(const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::uint8_t kPng[] = {0x89, 'P', 'N', 'G'};
  constexpr std::size_t kPngWidth = 16, kPngHeight = 20, kPngHead = 24;
  if (isJpeg(bytes, size)) return sizeOfJpeg(bytes, size);
  if (size >= kPngHead && std::memcmp(bytes, kPng, sizeof kPng) == 0)
    return {bigEndian32(bytes + kPngWidth), bigEndian32(bytes + kPngHeight), 0, 0};
  return {};
}

/** The decoded image, empty when that fails or tells of damage, and what OpenCV's decoders print.
 * The warnings of libpng are about things that do not change the image. */
std::pair<cv::Mat, std::string> decodedByOpenCV(
    const std::uint8_t* bytes, std::size_t size, int flags)
{
  const StderrCapture capture;
  try
  {
    const cv::Mat encoded(1, static_cast<int>(size), CV_8U, const_cast<std::uint8_t*>(bytes));
    cv::Mat image = cv::imdecode(encoded, flags | cv::IMREAD_IGNORE_ORIENTATION);
    const std::string remarks = capture.text();
    if (tellsDamage(remarks)) image.release();
    return {image, remarks};
  }
  catch (const cv::Exception& e)
  {
    return {cv::Mat(), rootMessage(e)};
  }
}

/** The decoded image, empty when that fails, and why. */
std::pair<cv::Mat, std::string> decodedWithReason(
    const std::uint8_t* bytes, std::size_t size, const StatedSize& stated, int flags)
{
  if (!isJpeg(bytes, size)) return decodedByOpenCV(bytes, size, flags);
  const DecodedJpeg decoded =
      decodedJpeg(bytes, size, static_cast<int>(stated.height), static_cast<int>(stated.width));
  if (!decoded.image.empty() || decoded.isDamaged) return {decoded.image, decoded.reason};
  return {decodedByOpenCV(bytes, size, flags).first, decoded.reason};
}

void requireModest(const StatedSize& stated, std::uint64_t mostPixels)
{
  if (stated.width == 0 || stated.height == 0)
    throw std::runtime_error("cannot be read as an image: is neither a JPEG nor a PNG file");
  if (stated.height > mostPixels / stated.width)
    throw std::runtime_error(mrpt::format(
        "has %llux%llu pixels, more than %llu million",
        static_cast<unsigned long long>(stated.width),
        static_cast<unsigned long long>(stated.height),
        static_cast<unsigned long long>(mostPixels >> 20)));
  if (std::max<std::uint64_t>(stated.width, stated.height) > kLongestImageSide)
    throw std::runtime_error(mrpt::format(
        "has %llux%llu pixels, more than %llu in a row or a column",
        static_cast<unsigned long long>(stated.width),
        static_cast<unsigned long long>(stated.height),
        static_cast<unsigned long long>(kLongestImageSide)));
}

void requireDecoded(const cv::Mat& image, const std::string& reason)
{
  if (image.empty())
    throw std::runtime_error(
        "cannot be read as an image" + (reason.empty() ? "" : ": " + oneLine(reason)));
}
}  // namespace

cv::Mat decodeImage(
    const std::uint8_t* bytes, std::size_t size, int flags, std::uint64_t mostPixels)
{
  const StatedSize stated = statedSize(bytes, size);
  requireModest(stated, mostPixels);
  const auto [image, reason] = decodedWithReason(bytes, size, stated, flags);
  requireDecoded(image, reason);
  return image;
}

std::vector<std::uint8_t> readImageFile(const std::string& path)
{
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw std::runtime_error(error.message());
  if (size == 0) throw std::runtime_error("is empty");
  if (size > kMostBytes) throw std::runtime_error("has more than 256 MB");
  std::vector<std::uint8_t> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    throw std::runtime_error("cannot be read");
  return bytes;
}

cv::Mat decodeImageFile(const std::string& path, int flags, std::uint64_t mostPixels)
{
  const auto bytes = readImageFile(path);
  return decodeImage(bytes.data(), bytes.size(), flags, mostPixels);
}

std::optional<ImageSize> sizeOfColorJpeg(
    const std::vector<std::uint8_t>& bytes, std::uint64_t mostPixels)
{
  constexpr unsigned kBits = 8, kChannels = 3;
  if (!isJpeg(bytes.data(), bytes.size())) return std::nullopt;
  const StatedSize stated = sizeOfJpeg(bytes.data(), bytes.size());
  if (stated.bits != kBits || stated.channels != kChannels) return std::nullopt;
  requireModest(stated, mostPixels);
  constexpr int kReduction = 8;  // needs all of the bytes, and little of the work
  const ImageSize size{static_cast<unsigned>(stated.width), static_cast<unsigned>(stated.height)};
  const DecodedJpeg small = decodedJpeg(
      bytes.data(), bytes.size(), static_cast<int>(size.height), static_cast<int>(size.width),
      kReduction);
  if (small.image.empty() && !small.isDamaged)
  {
    decodeImage(bytes.data(), bytes.size(), cv::IMREAD_COLOR, mostPixels);
    return std::nullopt;
  }
  requireDecoded(small.image, small.reason);
  return size;
}

}  // namespace quadmap
