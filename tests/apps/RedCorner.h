#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "../detection/TinyDetector.h"
#include "../sensors/SampleRawlog.h"

namespace quadmap
{
/** Sample scans with something red in the upper left corner, where TinyDetector sees a chair. */
inline std::vector<mrpt::obs::CObservation3DRangeScan::Ptr> redCornerScans(int count)
{
  std::vector<mrpt::obs::CObservation3DRangeScan::Ptr> scans;
  for (int i = 0; i < count; ++i)
  {
    auto scan = sampleScan(kStart + 0.1 * i);
    cv::Mat image(kRows, kColumns, CV_8UC3, cv::Scalar(0, 80, 0));
    image(cv::Rect(0, 0, kColumns / 8, kRows / 8)).setTo(cv::Scalar(0, 0, 255));
    scan->intensityImage = mrpt::img::CImage(image, mrpt::img::DEEP_COPY);
    scans.push_back(scan);
  }
  return scans;
}

inline std::string writeScans(
    const std::string& path, const std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>& scans)
{
  return writeObjects(path, {scans.begin(), scans.end()});
}

}  // namespace quadmap
