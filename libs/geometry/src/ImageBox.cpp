#include "quadmap/geometry/ImageBox.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
bool ImageBox::isValid() const
{
  return std::isfinite(x1) && std::isfinite(y1) && std::isfinite(x2) && std::isfinite(y2) &&
         x2 > x1 && y2 > y1;
}

ImageBox ImageBox::clipped(unsigned imageWidth, unsigned imageHeight) const
{
  if (!isValid()) return *this;
  const double xMax = double(imageWidth) - 1, yMax = double(imageHeight) - 1;
  return {std::max(x1, 0.0), std::max(y1, 0.0), std::min(x2, xMax), std::min(y2, yMax)};
}

double imageBoxIoU(const ImageBox& a, const ImageBox& b)
{
  if (!a.isValid() || !b.isValid()) return 0;
  const ImageBox common{
      std::max(a.x1, b.x1), std::max(a.y1, b.y1), std::min(a.x2, b.x2), std::min(a.y2, b.y2)};
  return common.area() / (a.area() + b.area() - common.area());
}

}  // namespace quadmap
