#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Correspondences.h"
#include "MotionEstimator.h"
#include "StepCovariance.h"
#include "VisualImage.h"
#include "quadmap/odometry/VisualOdometry.h"

namespace quadmap
{
/** What VisualOdometry does. The functions that find the motion of an image are in
 * VisualOdometryImpl_locate.cpp, all others in VisualOdometry.cpp. */
struct VisualOdometry::Impl
{
  /** An image that others are compared with. */
  struct Reference
  {
    std::shared_ptr<const VisualImage> image;
    Eigen::Isometry3d T_map_optical;
    Corners corners;
    std::vector<SurfaceSample> surface;
    std::optional<Descriptors> descriptors;  // computed when first needed

    Reference(
        std::shared_ptr<const VisualImage> from,
        const Eigen::Isometry3d& pose,
        const VisualOdometryOptions& options) :
        image(std::move(from)),
        T_map_optical(pose),
        corners(findCorners(*image, options)),
        surface(sampleSurface(*image))
    {
    }
  };

  /** The latest image with a pose. */
  struct LastImage
  {
    std::shared_ptr<const VisualImage> image;
    Eigen::Isometry3d T_map_optical;
    double time = 0;                       // [s]
    Matrix6 covariance = Matrix6::Zero();  // against its keyframe, in the map
    Vector6 velocity = Vector6::Zero();    // in the optical frame [m/s], [rad/s]
  };

  Impl(const VisualOdometryOptions& o, const mrpt::poses::CPose3D& T_map_first) :
      options(o), estimator(options), T_map_robot(isometryOf(T_map_first))
  {
  }

  const VisualOdometryOptions options;
  const MotionEstimator estimator;
  Eigen::Isometry3d T_map_robot;  // of the last image with a pose
  std::optional<Reference> keyframe;
  std::optional<LastImage> last;
  std::optional<Eigen::Isometry3d> T_map_marked;  // pose of the robot at the last takeStep()
  StepCovariance uncertainty;
  VisualOdometryCounts counts;
  std::vector<std::string> warnings;
  std::size_t failedInARow = 0;

  bool add(const mrpt::obs::CObservation3DRangeScan& scan);
  std::optional<MotionEstimate> locate(
      const std::shared_ptr<const VisualImage>& image, double time);
  std::optional<MotionEstimate> byFlow(
      const VisualImage& image, double time, const Eigen::Isometry3d& T_image_key);
  std::optional<MotionEstimate> byDescriptors(
      const VisualImage& image, std::optional<Descriptors>& found, double time);
  bool isCredible(const MotionEstimate& estimate, double minShare, double time) const;
  bool isPlausible(const MotionEstimate& estimate, double time) const;
  Eigen::Isometry3d predicted(double time) const;
  bool canStart(const Reference& reference) const;
  bool start(const std::shared_ptr<const VisualImage>& image, double time);
  void accept(
      const std::shared_ptr<const VisualImage>& image, double time, const MotionEstimate& estimate);
  bool needsKeyframe(const MotionEstimate& estimate) const;
  void makeKeyframe();
  void fail(double time);
};

}  // namespace quadmap
