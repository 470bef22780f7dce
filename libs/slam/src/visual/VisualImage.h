#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <vector>

#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/slam/visual/VisualOdometryOptions.h"

namespace quadmap
{
/** One RGB-D image as visual odometry sees it: brightness and depth of one camera, that of the
 * colour image (without one: the depth camera), at about 320 columns. */
class VisualImage
{
 public:
  VisualImage(const mrpt::obs::CObservation3DRangeScan& scan, const VisualOdometryOptions& options);

  const PinholeCamera& camera() const { return camera_; }  //!< Of the working image
  const cv::Mat& gray() const { return gray_; }            //!< 8 bits; empty: there is none
  const std::vector<cv::Mat>& pyramid() const { return pyramid_; }  //!< Of gray, for optical flow
  const cv::Mat& fullGray() const { return fullGray_; }             //!< In the camera's resolution
  double reduction() const { return reduction_; }  //!< Camera pixels per working pixel

  /** The optical frame of this image in the frame of the robot. */
  const Eigen::Isometry3d& T_robot_optical() const { return T_robot_optical_; }

  /** Depth between pixels [m]; 0 where there is none or at the edge of a surface. */
  double depthAt(double u, double v) const;

  /** Depth of a pixel [m], 0 = none; the pixel lies inside. */
  float depth(int u, int v) const { return depth_(v, u); }
  int columns() const { return depth_.cols; }
  int rows() const { return depth_.rows; }
  bool inside(double u, double v) const
  {
    return u >= 0 && v >= 0 && u <= columns() - 1 && v <= rows() - 1;
  }
  Eigen::Vector3d point(double u, double v, double z) const { return z * camera_.ray(u, v); }

 private:
  void makeGray(const mrpt::obs::CObservation3DRangeScan& scan);
  void copyDepth(const mrpt::obs::CObservation3DRangeScan& scan);
  void registerDepth(const mrpt::obs::CObservation3DRangeScan& scan);

  double minRange_, maxRange_;  //!< Of depths that are used [m]
  PinholeCamera camera_;
  int reduction_ = 1;
  Eigen::Isometry3d T_robot_optical_;
  cv::Mat gray_, fullGray_;
  std::vector<cv::Mat> pyramid_;
  cv::Mat_<float> depth_;
};

}  // namespace quadmap
