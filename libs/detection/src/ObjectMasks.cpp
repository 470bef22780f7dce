#include "ObjectMasks.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace quadmap
{
namespace
{
/** The sum over all prototypes, height x width. */
cv::Mat sumOf(const Tensor& prototypes, const std::vector<float>& coefficients)
{
  const int count = prototypes.shape[0], rows = prototypes.shape[1], columns = prototypes.shape[2];
  const cv::Mat factors(1, count, CV_32F, const_cast<float*>(coefficients.data()));
  const cv::Mat flat(count, rows * columns, CV_32F, const_cast<float*>(prototypes.data));
  return cv::Mat(factors * flat).reshape(1, rows);
}

}  // namespace

std::optional<ObjectMask> objectMask(
    const Tensor& prototypes,
    const RawBox& rawBox,
    const ImageBox& box,
    const Placement& place,
    cv::Size input)
{
  const cv::Mat sum = sumOf(prototypes, rawBox.maskCoefficients);
  ObjectMask mask;
  mask.x0 = static_cast<unsigned>(std::ceil(box.x1));
  mask.y0 = static_cast<unsigned>(std::ceil(box.y1));
  const double right = std::floor(box.x2), bottom = std::floor(box.y2);
  if (right < mask.x0 || bottom < mask.y0) return std::nullopt;
  mask.width = static_cast<unsigned>(right) - mask.x0 + 1;
  mask.height = static_cast<unsigned>(bottom) - mask.y0 + 1;

  // From pixels of the mask to those of the prototypes; both count from their first centre.
  const double perX = static_cast<double>(sum.cols) / input.width;
  const double perY = static_cast<double>(sum.rows) / input.height;
  const auto prototypeX = [&](double x)
  { return ((x + mask.x0 + 0.5) * place.scaleX + place.area.x) * perX - 0.5; };
  const auto prototypeY = [&](double y)
  { return ((y + mask.y0 + 0.5) * place.scaleY + place.area.y) * perY - 0.5; };
  const cv::Matx23d toPrototype(
      place.scaleX * perX, 0, prototypeX(0), 0, place.scaleY * perY, prototypeY(0));
  cv::Mat fine;
  cv::warpAffine(
      sum, fine, toPrototype, cv::Size(static_cast<int>(mask.width), static_cast<int>(mask.height)),
      cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  std::for_each(
      fine.begin<float>(), fine.end<float>(),
      [&](float value) { mask.pixels.push_back(value > 0); });
  if (!mask.pixels.hasOnes()) return std::nullopt;
  return mask;
}

}  // namespace quadmap
