#include "Letterbox.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace quadmap
{
Placement Placement::of(cv::Size image, cv::Size input, Fit fit)
{
  Placement place;
  place.area = {0, 0, input.width, input.height};
  if (fit != Fit::Stretch)
  {
    const double scale = std::min(
        static_cast<double>(input.width) / image.width,
        static_cast<double>(input.height) / image.height);
    place.area.width = std::clamp(cvRound(image.width * scale), 1, input.width);
    place.area.height = std::clamp(cvRound(image.height * scale), 1, input.height);
  }
  if (fit == Fit::Centre)
  {
    place.area.x = (input.width - place.area.width) / 2;
    place.area.y = (input.height - place.area.height) / 2;
  }
  place.scaleX = static_cast<double>(place.area.width) / image.width;
  place.scaleY = static_cast<double>(place.area.height) / image.height;
  return place;
}

ImageBox Placement::toImage(const ImageBox& box) const
{
  return {
      (box.x1 - area.x) / scaleX, (box.y1 - area.y) / scaleY, (box.x2 - area.x) / scaleX,
      (box.y2 - area.y) / scaleY};
}

InputBlob::InputBlob(const Format& format) : format_(format)
{
  const int shape[] = {1, 3, format.size.height, format.size.width};
  blob_.create(4, shape, CV_32F);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t grey = 0; grey < 256; ++grey)
      value_[c][grey] =
          static_cast<float>((static_cast<double>(grey) - format.mean[c]) / format.deviation[c]);
}

Placement InputBlob::fill(const cv::Mat& bgr)
{
  const Placement place = Placement::of(bgr.size(), format_.size, format_.fit);
  if (bgr.size() == place.area.size())
    scaled_ = bgr;
  else
    cv::resize(bgr, scaled_, place.area.size(), 0, 0, cv::INTER_LINEAR);
  for (int c = 0; c < 3; ++c)
  {
    const auto& value = value_[static_cast<std::size_t>(c)];
    const int source = format_.order == ChannelOrder::Rgb ? 2 - c : c;
    cv::Mat plane(format_.size, CV_32F, blob_.ptr<float>(0, c));
    if (place.area.size() != format_.size)
      plane.setTo(static_cast<double>(value[static_cast<std::size_t>(cvRound(format_.padding))]));
    for (int y = 0; y < scaled_.rows; ++y)
    {
      const std::uint8_t* from = scaled_.ptr<std::uint8_t>(y) + source;
      float* to = plane.ptr<float>(place.area.y + y) + place.area.x;
      for (int x = 0; x < scaled_.cols; ++x) to[x] = value[from[3 * x]];
    }
  }
  return place;
}

}  // namespace quadmap
