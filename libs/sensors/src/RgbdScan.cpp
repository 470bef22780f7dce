#include "quadmap/sensors/RgbdScan.h"

#include <mrpt/core/Clock.h>

#include <cstring>
#include <opencv2/core.hpp>

namespace quadmap
{
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

}  // namespace quadmap
