#include "frames/FrameImages.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <utility>

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
  namespace fs = std::filesystem;
  std::error_code error;
  const auto type = fs::status(path, error).type();
  if (type == fs::file_type::not_found) throw std::runtime_error(path + ": no such file");
  if (error) throw std::runtime_error(path + ": " + error.message());
  if (type != fs::file_type::regular) throw std::runtime_error(path + ": is no file");
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

cv::Mat loadColor(const std::string& path)
{
  const cv::Mat image = loadImage(path, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
  if (image.type() != CV_8UC3)
    throw std::runtime_error(path + ": is no colour image (8 bits a channel)");
  return image;
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

constexpr std::size_t kSampledImages = 9;  //!< Enough that four damaged ones decide nothing

/** Counts sizes of images. */
class ImageSizes
{
 public:
  void add(const std::string& file)
  try
  {
    const cv::Size size = loadImage(file, cv::IMREAD_UNCHANGED).size();
    const auto same = [&](const auto& counted) { return counted.first == size; };
    const auto it = std::find_if(counts_.begin(), counts_.end(), same);
    if (it == counts_.end())
      counts_.emplace_back(size, 1);
    else
      ++it->second;
  }
  catch (const std::exception& e)  // who imports this image meets the same error
  {
    if (problem_.empty()) problem_ = e.what();
  }

  bool isEmpty() const { return counts_.empty(); }

  /** \exception std::runtime_error If no image could be read: why the first could not. */
  cv::Size mostFrequent() const
  {
    if (counts_.empty()) throw std::runtime_error(problem_);
    const auto rarer = [](const auto& a, const auto& b) { return a.second < b.second; };
    return std::max_element(counts_.begin(), counts_.end(), rarer)->first;
  }

 private:
  std::vector<std::pair<cv::Size, int>> counts_;  // in the order of their first images
  std::string problem_;
};
}  // namespace

FrameImages loadImages(const FolderFrame& frame, const FolderContent& content)
{
  const auto& camera = content.camera;
  FrameImages images;
  if (content.images)
    images = content.images->read(frame);
  else
    images.color = loadColor(frame.color);
  requireSize(images.color.size(), frame.color, camera.color, camera.origin);
  images.depth =
      content.images ? registered(images.depth, frame.depth, camera) : loadDepth(frame, camera);
  return images;
}

cv::Size sizeOfImages(const std::vector<FolderFrame>& frames, std::string FolderFrame::*file)
{
  ImageSizes sizes;
  const std::size_t sampled = std::min(kSampledImages, frames.size());
  for (std::size_t i = 0; i < sampled; ++i)
    sizes.add(frames[i * (frames.size() - 1) / std::max<std::size_t>(sampled - 1, 1)].*file);
  for (std::size_t i = 0; i < frames.size() && sizes.isEmpty(); ++i) sizes.add(frames[i].*file);
  return sizes.mostFrequent();
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
