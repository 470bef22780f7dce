#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "quadmap/geometry/ImageBox.h"

namespace quadmap
{
/** How an image is brought to the size of a network's input. */
enum class Fit
{
  Centre,   //!< With its proportions, in the middle
  TopLeft,  //!< With its proportions, at the upper left
  Stretch   //!< Over the whole input
};

enum class ChannelOrder
{
  Rgb,
  Bgr
};

/** Where an image lies in a network's input. */
struct Placement
{
  cv::Rect area;                  //!< Of the input that has the image [px]
  double scaleX = 1, scaleY = 1;  //!< Pixels of the input per pixel of the image

  static Placement of(cv::Size image, cv::Size input, Fit fit);

  /** A box of the input in pixels of the image. */
  ImageBox toImage(const ImageBox& box) const;
};

/** Turns images into the numbers that a network reads. */
class InputBlob
{
 public:
  struct Format
  {
    cv::Size size;
    Fit fit = Fit::Centre;
    double padding = 0;  //!< Grey value around the image
    ChannelOrder order = ChannelOrder::Rgb;
    std::array<double, 3> mean{}, deviation{};  //!< In the order of the channels
  };

  explicit InputBlob(const Format& format);

  /** Fills the blob. \param bgr Image of three channels of 8 bits. */
  Placement fill(const cv::Mat& bgr);

  const cv::Mat& blob() const { return blob_; }  //!< 1 x 3 x height x width, float

 private:
  Format format_;
  std::array<std::array<float, 256>, 3> value_;  //!< Of each grey value, by channel
  cv::Mat blob_, scaled_;
};

}  // namespace quadmap
