#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
/** The images of one frame. */
struct FrameImages
{
  cv::Mat color;  //!< 3 x 8 bits, blue first
  cv::Mat depth;  //!< 16 bits, 0 = no measurement
};

/** Reads the images of a frame from what is not an image file. */
class FrameImageReader
{
 public:
  virtual ~FrameImageReader() = default;
  /** \exception std::runtime_error If they cannot be read. The message names the file. */
  virtual FrameImages read(const FolderFrame& frame) const = 0;
};

/** The images of a frame as the camera has them, with depth registered to the colour camera at the
 * size of rectifiedCameraOf() it. \exception std::runtime_error If they cannot be read, have
 * another size than the camera, or depth is no depth image. The message names the file. */
FrameImages loadImages(const FolderFrame& frame, const FolderContent& content);

/** The size that most of the images of a recording have: of a few of them, spread over all of it,
 * those that can be read count. The first wins a tie.
 * \param file The colour or the depth image of a frame.
 * \exception std::runtime_error If none of all images can be read. Names the first file. */
cv::Size sizeOfImages(const std::vector<FolderFrame>& frames, std::string FolderFrame::*file);

/** Only the depth image, from its file. \exception std::runtime_error As loadImages(). */
cv::Mat loadDepth(const FolderFrame& frame, const FolderCamera& camera);

/** The bytes of the colour image's file if it is an undamaged JPEG in colour; empty if it is an
 * image of another format. \exception std::runtime_error As loadImages(). */
std::vector<std::uint8_t> loadJpeg(const FolderFrame& frame, const FolderCamera& camera);

}  // namespace quadmap
