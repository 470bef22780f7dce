#pragma once

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/geometry/ImageBox.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** A magnified image to draw on, in pixels of the image as it was. */
class FrameCanvas
{
 public:
  /** \param bgr Three channels of 8 bits. */
  FrameCanvas(const cv::Mat& bgr, const PinholeCamera& camera);

  enum class Weight
  {
    Thin = 1,
    Bold = 3
  };
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, cv::Scalar color, Weight weight);

  /** A row of text. */
  struct Text
  {
    std::string text;
    cv::Scalar color;
  };
  /** Rows of text on a dark ground, moved together into the picture and below earlier texts. Empty
   * ones are left out. */
  using Texts = std::vector<Text>;
  void textsBelow(const Eigen::Vector2d& at, const Texts& rows);  //!< at: upper left [px of image]
  void textsAbove(const Eigen::Vector2d& at, const Texts& rows);  //!< at: lower left [px of image]

  /** Mixes a colour into the pixels of a mask. */
  void tint(const ObjectMask& mask, cv::Scalar color);

  /** The edges of the circumscribed cuboid, as far as they are in front of the camera. */
  void cuboid(const Ellipsoid& object_optical, cv::Scalar color);

  /** Fills the lower side (-z) of the cuboid when all of it is in front of the camera. */
  void fillBottom(const Ellipsoid& object_optical, cv::Scalar color);

  /** The outline of the ellipsoid. \return Its uppermost point, or nothing when the object is not
   *  entirely in front of the camera. */
  std::optional<Eigen::Vector2d> outline(const Ellipsoid& object_optical, cv::Scalar color);

  const cv::Mat& picture() const { return picture_; }

 private:
  cv::Point2d onPicture(const Eigen::Vector2d& pixel) const;
  void writeTexts(const cv::Point& corner, const Texts& rows);
  int freeRow(const cv::Rect& text) const;

  PinholeCamera camera_;
  int scale_ = 1;
  cv::Mat picture_;
  std::vector<cv::Rect> texts_;  // that were drawn [px of the picture]
};

}  // namespace quadmap
