#include "VisualImage.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "FlowSettings.h"
#include "RigidMotion.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/FrameAgreement.h"

namespace quadmap
{
using mrpt::obs::CObservation3DRangeScan;

namespace
{
constexpr int kWorkingColumns = 320;  // half of VGA is as accurate and costs a third [px]

/** Whether two depths may lie on one surface [m]. */
bool onOneSurface(float a, float b) { return std::abs(a - b) < 0.02f + 0.02f * std::min(a, b); }

/** The camera whose pixels are blocks of reduction x reduction pixels. */
PinholeCamera reduced(PinholeCamera camera, int reduction)
{
  const double k = reduction;
  camera.fx /= k;
  camera.fy /= k;
  camera.cx = (camera.cx + 0.5) / k - 0.5;
  camera.cy = (camera.cy + 0.5) / k - 0.5;
  camera.width /= static_cast<unsigned>(reduction);
  camera.height /= static_cast<unsigned>(reduction);
  return camera;
}

bool hasGray(const CObservation3DRangeScan& scan)
{
  const auto& camera = scan.cameraParamsIntensity;
  return scan.hasIntensityImage && !scan.intensityImage.isEmpty() &&
         scan.intensityImage.getWidth() == camera.ncols &&
         scan.intensityImage.getHeight() == camera.nrows && camera.fx() != 0 && camera.fy() != 0;
}

/** Whether the pixels of depth and colour image belong together one to one. */
bool isRegistered(const CObservation3DRangeScan& scan)
{
  const auto &a = scan.cameraParams, &b = scan.cameraParamsIntensity;
  return scan.doDepthAndIntensityCamerasCoincide() && a.ncols == b.ncols && a.nrows == b.nrows &&
         sameCalibration(a, b);
}

}  // namespace

VisualImage::VisualImage(
    const CObservation3DRangeScan& scan, const VisualOdometryOptions& options) :
    minRange_(options.minRange), maxRange_(options.maxRange)
{
  const bool gray = hasGray(scan);
  const PinholeCamera full = pinholeFrom(gray ? scan.cameraParamsIntensity : scan.cameraParams);
  reduction_ = std::max(1, static_cast<int>(full.width) / kWorkingColumns);
  camera_ = reduced(full, reduction_);
  depth_ =
      cv::Mat_<float>::zeros(static_cast<int>(camera_.height), static_cast<int>(camera_.width));
  T_robot_optical_ = isometryOf(scan.sensorPose + T_sensor_optical());
  if (gray)
  {
    T_robot_optical_ = isometryOf(scan.sensorPose + scan.relativePoseIntensityWRTDepth);
    makeGray(scan);
  }
  if (!gray || isRegistered(scan))
    copyDepth(scan);
  else
    registerDepth(scan);
}

void VisualImage::makeGray(const CObservation3DRangeScan& scan)
{
  const cv::Mat& image = scan.intensityImage.asCvMatRef();
  if (image.channels() == 1)
    fullGray_ = image.clone();
  else
    cv::cvtColor(image, fullGray_, cv::COLOR_BGR2GRAY);
  if (fullGray_.depth() != CV_8U) fullGray_.convertTo(fullGray_, CV_8U, 1 / 256.0);
  const auto& dist = scan.cameraParamsIntensity.dist;
  const bool distorted = std::any_of(dist.begin(), dist.end(), [](double d) { return d != 0; });
  if (distorted && !isRegistered(scan))
  {
    const auto& c = scan.cameraParamsIntensity;
    const cv::Matx33d K(c.fx(), 0, c.cx(), 0, c.fy(), c.cy(), 0, 0, 1);
    cv::Mat straight;
    cv::undistort(fullGray_, straight, K, std::vector<double>(dist.begin(), dist.end()));
    fullGray_ = straight;
  }
  const cv::Size size(depth_.cols, depth_.rows);
  const cv::Rect whole(0, 0, size.width * reduction_, size.height * reduction_);
  cv::resize(fullGray_(whole), gray_, size, 0, 0, cv::INTER_AREA);
  cv::buildOpticalFlowPyramid(gray_, pyramid_, flow::window(), flow::kPyramidLevels);
}

void VisualImage::copyDepth(const CObservation3DRangeScan& scan)
{
  for (int v = 0; v < rows(); ++v)
    for (int u = 0; u < columns(); ++u)
    {
      float sum = 0, least = 1e9f, most = 0;
      int count = 0;
      for (int y = v * reduction_; y < (v + 1) * reduction_; ++y)
        for (int x = u * reduction_; x < (u + 1) * reduction_; ++x)
        {
          const float z = static_cast<float>(scan.rangeImage(y, x)) * scan.rangeUnits;
          if (!(z >= minRange_ && z <= maxRange_)) continue;
          sum += z;
          least = std::min(least, z);
          most = std::max(most, z);
          ++count;
        }
      if (count > 0 && onOneSurface(least, most)) depth_(v, u) = sum / static_cast<float>(count);
    }
}

void VisualImage::registerDepth(const CObservation3DRangeScan& scan)
{
  const PinholeCamera depthCamera = pinholeFrom(scan.cameraParams);
  const Eigen::Isometry3d T_gray_depth =
      T_robot_optical_.inverse() * isometryOf(scan.sensorPose + T_sensor_optical());
  for (int y = 0; y < scan.rangeImage.rows(); ++y)
    for (int x = 0; x < scan.rangeImage.cols(); ++x)
    {
      const double range = static_cast<double>(scan.rangeImage(y, x)) * scan.rangeUnits;
      if (!(range >= minRange_ && range <= maxRange_)) continue;
      const Eigen::Vector3d p = T_gray_depth * (range * depthCamera.ray(x, y));
      if (p.z() < minRange_) continue;
      const Eigen::Vector2d pixel = camera_.project(p);
      if (!inside(pixel.x(), pixel.y())) continue;
      float& z = depth_(
          static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
      if (z == 0 || p.z() < z)
        z = static_cast<float>(p.z());  // the nearer one hides the farther one
    }
}

double VisualImage::depthAt(double u, double v) const
{
  if (!inside(u, v)) return 0;
  const int u0 = std::min(static_cast<int>(u), columns() - 2);
  const int v0 = std::min(static_cast<int>(v), rows() - 2);
  if (u0 < 0 || v0 < 0) return 0;
  const float z[4] = {
      depth_(v0, u0), depth_(v0, u0 + 1), depth_(v0 + 1, u0), depth_(v0 + 1, u0 + 1)};
  const auto [least, most] = std::minmax_element(z, z + 4);
  if (*least <= 0 || !onOneSurface(*least, *most)) return 0;
  const double a = u - u0, b = v - v0;
  return (1 - b) * ((1 - a) * z[0] + a * z[1]) + b * ((1 - a) * z[2] + a * z[3]);
}

}  // namespace quadmap
