#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <string>

namespace cv
{
class Mat;
}

namespace quadmap
{
/** Sensor label of what quadmap makes of recordings and cameras. */
inline const std::string kCameraLabel = "camera";

/** A colour and a depth image in the form of MRPT, with the label kCameraLabel. The caller sets the
 * calibrations and where the camera is on the robot.
 * \param time [s since 1970].
 * \param color 3 x 8 bits, blue first. The scan shares the pixels.
 * \param depth 16 bits along the optical axis, 0 = no measurement. The pixels are copied.
 * \param depthUnit Of `depth` [m]. */
mrpt::obs::CObservation3DRangeScan::Ptr makeRgbdScan(
    double time, const cv::Mat& color, const cv::Mat& depth, double depthUnit);

/** Bytes of all images that the scan holds in memory, with its pixel labels. */
std::size_t imageBytesOf(const mrpt::obs::CObservation3DRangeScan& scan);

}  // namespace quadmap
