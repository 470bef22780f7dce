#include "ImagePairs.h"

#include <cmath>

namespace quadmap
{
std::optional<ImagePairs::Pair> ImagePairs::add(DeviceImage image)
{
  const bool isDepth = image.kind == DeviceImage::Kind::Depth;
  if (isDepth) countLost(image);
  if (isDepth && depth_) ++unpaired_;
  (isDepth ? depth_ : color_) = std::move(image);
  if (!depth_ || !color_ || std::abs(depth_->time - color_->time) > maxDelay_) return std::nullopt;
  Pair pair{std::move(*depth_), std::move(*color_)};
  depth_.reset();
  color_.reset();
  return pair;
}

void ImagePairs::countLost(const DeviceImage& depth)
{
  // A camera that starts anew counts from the beginning.
  if (lastNumber_ && depth.number > *lastNumber_ + 1)
    lost_ += static_cast<std::size_t>(depth.number - *lastNumber_ - 1);
  lastNumber_ = depth.number;
}

}  // namespace quadmap
