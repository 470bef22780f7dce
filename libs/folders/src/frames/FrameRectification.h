#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "quadmap/folders/FolderCamera.h"
#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** The camera of the rectified images: the colour camera without distortion, at the size of the
 * depth images. */
mrpt::img::TCamera rectifiedCameraOf(const FolderCamera& camera);

/** Why the distortion of a lens cannot be undone, as a phrase: it shows two directions at one pixel
 * of the image, or the search for what is seen at a pixel fails. Nothing when it can. */
std::optional<std::string> whyNotRectifiable(const FolderCamera& camera);

/** Takes images and boxes from the colour camera to rectifiedCameraOf() it. */
class FrameRectification
{
 public:
  explicit FrameRectification(const FolderCamera& camera);

  cv::Mat color(const cv::Mat& image) const;  //!< Black where the camera did not look
  cv::Mat depth(const cv::Mat& image) const;  //!< Registered to the colour image; nearest pixels

  /** The smallest upright box around a box's outline: doc/mathematics.md, (24.2). An edge at the
   * border of the image stays there, as the object may go on beyond. */
  ImageBox box(const ImageBox& box) const;

 private:
  mrpt::img::TCamera from_, to_;
  cv::Mat mapX_, mapY_;  // of each rectified pixel, where it is in the image of the file
};

}  // namespace quadmap
