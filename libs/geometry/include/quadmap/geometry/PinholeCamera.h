#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>

namespace quadmap
{
/** Pinhole camera without distortion. Its frame is `optical`: x right, y down, z forward. fy may be
 * negative, as in ICL-NUIM: the image is then upside down in this frame. */
struct PinholeCamera
{
  double fx = 0, fy = 0, cx = 0, cy = 0;  //!< [px]
  unsigned width = 0, height = 0;         //!< [px]

  /** Pixel of a point with z > 0. */
  Eigen::Vector2d project(const Eigen::Vector3d& p_optical) const
  {
    return {fx * p_optical.x() / p_optical.z() + cx, fy * p_optical.y() / p_optical.z() + cy};
  }
  /** Point at depth 1 m on the ray of a pixel. */
  Eigen::Vector3d ray(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }

  Eigen::Matrix3d matrix() const;  //!< K
};

/** Pose of the optical frame in an MRPT sensor frame (x forward, y left, z up). */
const mrpt::poses::CPose3D& T_sensor_optical();

}  // namespace quadmap
