#include "quadmap/sensors/RgbdScan.h"

#include <mrpt/core/Clock.h>

#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>

namespace quadmap
{
namespace
{
std::size_t bytesOf(const mrpt::img::CImage& image)
{
  return image.isExternallyStored() || image.isEmpty() ? 0
                                                       : image.getHeight() * image.getRowStride();
}

/** Zero when the labels are of another number of bytes. */
template <unsigned int Bytes>
std::size_t bytesOfLabels(const mrpt::obs::TPixelLabelInfoBase& labels)
{
  const auto* info = dynamic_cast<const mrpt::obs::TPixelLabelInfo<Bytes>*>(&labels);
  return info ? static_cast<std::size_t>(info->pixelLabels.size()) *
                    sizeof(*info->pixelLabels.data())
              : 0;
}
}  // namespace

mrpt::obs::CObservation3DRangeScan::Ptr makeRgbdScan(
    double time, const cv::Mat& color, const cv::Mat& depth, double depthUnit)
{
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->timestamp = mrpt::Clock::fromDouble(time);
  scan->sensorLabel = kCameraLabel;
  scan->hasIntensityImage = scan->hasRangeImage = true;
  scan->intensityImage = mrpt::img::CImage(color, mrpt::img::SHALLOW_COPY);
  scan->rangeUnits = static_cast<float>(depthUnit);
  scan->range_is_depth = true;
  scan->rangeImage_setSize(depth.rows, depth.cols);
  for (int row = 0; row < depth.rows; ++row)
    std::memcpy(
        &scan->rangeImage(row, 0), depth.ptr(row),
        static_cast<std::size_t>(depth.cols) * sizeof(std::uint16_t));
  return scan;
}

std::size_t imageBytesOf(const mrpt::obs::CObservation3DRangeScan& scan)
{
  const auto bytesOfDepth = [](const mrpt::math::CMatrix_u16& image)
  { return static_cast<std::size_t>(image.size()) * sizeof(std::uint16_t); };
  std::size_t bytes = bytesOfDepth(scan.rangeImage);
  for (const auto& layer : scan.rangeImageOtherLayers) bytes += bytesOfDepth(layer.second);
  bytes += bytesOf(scan.intensityImage) + bytesOf(scan.confidenceImage);
  if (const auto* labels = scan.pixelLabels.get())
    bytes += bytesOfLabels<1>(*labels) + bytesOfLabels<2>(*labels) + bytesOfLabels<3>(*labels) +
             bytesOfLabels<4>(*labels) + bytesOfLabels<8>(*labels);
  return bytes;
}

}  // namespace quadmap
