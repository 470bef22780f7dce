#include "frames/FrameImages.h"

#include <mrpt/core/format.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "frames/DepthRegistration.h"
#include "frames/FrameRectification.h"
#include "quadmap/sensors/CheckedReader.h"
#include "quadmap/sensors/EncodedImage.h"

namespace quadmap
{
namespace
{
/** What `read` gives of a file. Its messages do not name the file. */
template <typename Read>
auto readNamed(const std::string& path, const Read& read)
{
  std::error_code ignored;  // of names that are too long
  if (!std::filesystem::is_regular_file(path, ignored))
    throw std::runtime_error(path + ": no such file");
  try
  {
    return read();
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(path + ": " + e.what());
  }
}

void requireSize(
    cv::Size size, const std::string& file, const mrpt::img::TCamera& camera, const std::string& of)
{
  if (size.width != static_cast<int>(camera.ncols) || size.height != static_cast<int>(camera.nrows))
    throw std::runtime_error(mrpt::format(
        "%s: is %dx%d, %s is for %ux%u", file.c_str(), size.width, size.height, of.c_str(),
        camera.ncols, camera.nrows));
}

cv::Mat loadImage(const std::string& path, int flags)
{
  return readNamed(path, [&] { return decodeImageFile(path, flags, RecordLimits().imagePixels); });
}

cv::Mat registered(cv::Mat depth, const std::string& file, const FolderCamera& camera)
{
  const auto& own = camera.depth ? camera.depth->camera : camera.color;
  requireSize(depth.size(), file, own, camera.origin);
  if (depth.type() != CV_16UC1)
    throw std::runtime_error(file + ": is no depth image (one channel of 16 bits)");
  if (camera.noDepth != 0) depth.setTo(0, depth == camera.noDepth);
  if (!camera.depth) return depth;
  return registeredDepth(depth, *camera.depth, rectifiedCameraOf(camera), camera.depthFactor);
}
}  // namespace

FrameImages loadImages(const FolderFrame& frame, const FolderContent& content)
{
  const auto& camera = content.camera;
  FrameImages images;
  if (content.images)
    images = content.images->read(frame);
  else
    images.color = loadImage(frame.color, cv::IMREAD_COLOR);
  requireSize(images.color.size(), frame.color, camera.color, camera.origin);
  images.depth =
      content.images ? registered(images.depth, frame.depth, camera) : loadDepth(frame, camera);
  return images;
}

cv::Size sizeOfImage(const std::string& file)
{
  return loadImage(file, cv::IMREAD_UNCHANGED).size();
}

cv::Mat loadDepth(const FolderFrame& frame, const FolderCamera& camera)
{
  return registered(loadImage(frame.depth, cv::IMREAD_UNCHANGED), frame.depth, camera);
}

std::vector<std::uint8_t> loadJpeg(const FolderFrame& frame, const FolderCamera& camera)
{
  std::vector<std::uint8_t> bytes;
  const auto size = readNamed(
      frame.color,
      [&]
      {
        bytes = readImageFile(frame.color);
        return sizeOfColorJpeg(bytes, RecordLimits().imagePixels);
      });
  if (!size) return {};
  const cv::Size pixels(static_cast<int>(size->width), static_cast<int>(size->height));
  requireSize(pixels, frame.color, camera.color, camera.origin);
  return bytes;
}

}  // namespace quadmap
