#include "FramePoints.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "IsometryOf.h"
#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
namespace
{
using mrpt::obs::CObservation3DRangeScan;

/** Finds the colours of points in the colour image of a scan. */
class ColourImage
{
 public:
  explicit ColourImage(const CObservation3DRangeScan& scan)
  {
    if (!scan.hasIntensityImage) return;
    image_ = scan.intensityImage.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    const bool coincide = scan.doDepthAndIntensityCamerasCoincide();
    camera_ = pinholeFrom(coincide ? scan.cameraParams : scan.cameraParamsIntensity);
    T_colour_optical_ =
        coincide ? Eigen::Isometry3d::Identity()
                 : isometryOf(-scan.relativePoseIntensityWRTDepth) * isometryOf(T_sensor_optical());
  }

  /** Grey where the image does not show the point. */
  Eigen::Vector3f at(const Eigen::Vector3f& p_optical) const
  {
    const Eigen::Vector3f grey(128, 128, 128);
    const Eigen::Vector3d p = T_colour_optical_ * p_optical.cast<double>();
    if (image_.empty() || !(p.z() > 0)) return grey;
    const Eigen::Vector2d pixel = camera_.project(p);
    if (!(pixel.cwiseAbs().maxCoeff() < 1e6)) return grey;
    const cv::Point at(cvRound(pixel.x()), cvRound(pixel.y()));
    if (!cv::Rect(0, 0, image_.cols, image_.rows).contains(at)) return grey;
    const std::uint8_t* value = image_.ptr(at.y, at.x);
    if (image_.channels() < 3) return Eigen::Vector3f::Constant(value[0]);
    return {float(value[2]), float(value[1]), float(value[0])};  // blue is first
  }

 private:
  cv::Mat image_;
  PinholeCamera camera_;
  Eigen::Isometry3d T_colour_optical_ = Eigen::Isometry3d::Identity();
};

}  // namespace

void forEachPoint(
    const KeyframeScan& image,
    const DenseOptions& options,
    const std::function<void(const MeasuredPoint&)>& visit)
{
  SurfaceOptions trusted;
  trusted.maxRange = options.maxRange;
  trusted.maxDepthNoiseFactor = 1;  // the noise is not asked of the cloud
  const DepthCloud cloud(*image.scan, trusted);
  const ColourImage colours(*image.scan);
  const Eigen::Isometry3f T_map_optical =
      (isometryOf(image.T_map_robot + image.scan->sensorPose) * isometryOf(T_sensor_optical()))
          .cast<float>();
  const Eigen::Vector3f eye = T_map_optical.translation();
  for (int r = 0; r < cloud.rows(); ++r)
    for (int c = 0; c < cloud.columns(); ++c)
    {
      if (!cloud.valid(c, r) || cloud.isFlyingPixel(c, r)) continue;
      const Eigen::Vector3f p_optical = cloud.point(c, r);
      const double sigma = trusted.depthSigma(p_optical.z()) / trusted.depthNoise.floor;
      MeasuredPoint point;
      point.position = T_map_optical * p_optical;
      point.toCamera = (eye - point.position).normalized();
      point.rgb = colours.at(p_optical);
      point.weight = static_cast<float>(1 / (sigma * sigma));
      visit(point);
    }
}

void forEachDepthImage(
    const std::string& result,
    ResultKeyframes::Boxes boxes,
    const DenseOptions& options,
    const std::function<void(const KeyframeScan&)>& visit,
    const std::function<void(double)>& progress)
{
  ResultKeyframes keyframes(result, boxes);
  const std::size_t step = (keyframes.size() + options.maxKeyframes - 1) / options.maxKeyframes;
  bool hasDepth = false;
  while (const auto images = keyframes.next())
  {
    const std::size_t number = keyframes.keyframesRead();
    for (const KeyframeScan& image : *images)
    {
      if ((number - 1) % step != 0 || !image.scan->hasRangeImage) continue;
      hasDepth = true;
      try
      {
        visit(image);
      }
      catch (const std::exception& e)
      {
        throw std::runtime_error(
            mrpt::format("%s: keyframe %zu: %s", keyframes.path().c_str(), number, e.what()));
      }
    }
    progress(static_cast<double>(number) / static_cast<double>(keyframes.size()));
  }
  if (!hasDepth) throw std::runtime_error(keyframes.path() + ": no keyframe has a depth image");
}

}  // namespace quadmap
