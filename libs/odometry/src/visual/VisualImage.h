#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <vector>

#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/odometry/VisualOdometryOptions.h"

namespace quadmap
{
/** One RGB-D image in the form that visual odometry uses: brightness and depth at about 320
 * columns. Both are in the colour camera or, when there is no colour, in the depth camera. */
class VisualImage
{
 public:
  VisualImage(const mrpt::obs::CObservation3DRangeScan& scan, const VisualOdometryOptions& options);

  const PinholeCamera& camera() const { return camera_; }  //!< Camera of the working image
  const cv::Mat& gray() const { return gray_; }  //!< 8 bits; empty when there is no colour
  const std::vector<cv::Mat>& pyramid() const
  {
    return pyramid_;
  }                                                      //!< Pyramid of gray(), for optical flow
  const cv::Mat& fullGray() const { return fullGray_; }  //!< Gray image in the camera's resolution
  double reduction() const { return reduction_; }        //!< Camera pixels per working pixel

  /** Pose of `optical` of this image in the frame of the robot. */
  const Eigen::Isometry3d& T_robot_optical() const { return T_robot_optical_; }

  /** Depth between pixels [m], or 0 where there is none or at a jump in depth. */
  double depthAt(double u, double v) const;

  /** Depth of a pixel inside the image [m], or 0 where there is none. */
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

  double minRange_, maxRange_;  //!< Range of the depths that are used [m]
  PinholeCamera camera_;
  int reduction_ = 1;
  Eigen::Isometry3d T_robot_optical_;
  cv::Mat gray_, fullGray_;
  std::vector<cv::Mat> pyramid_;
  cv::Mat_<float> depth_;
};

}  // namespace quadmap
