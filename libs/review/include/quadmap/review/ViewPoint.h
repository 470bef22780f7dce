#pragma once

#include <mrpt/opengl/CCamera.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

namespace quadmap
{
/** From where a scene is looked at: MRPT's orbit camera, projective, map frame z-up. */
struct ViewPoint
{
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  //!< Point in the middle of the picture [m]
  double distance = 10.0;                            //!< From the target to the eye [m], > 0
  double azimuth = 0;        //!< Of the eye seen from the target, from x towards y [rad]
  double elevation = 0;      //!< Of the eye above the target's horizontal plane [rad]
  double verticalFov = 0.5;  //!< Full opening angle of the picture's height [rad]

  Eigen::Vector3d toEye() const;  //!< Unit vector from the target to the eye
  Eigen::Vector3d eye() const { return target + distance * toEye(); }
  /** Axes of the picture in the map: columns right, up, towards the eye. */
  Eigen::Matrix3d axes() const;

  void applyTo(mrpt::opengl::CCamera& camera) const;
};

/** Of a rendered picture. */
struct PictureSize
{
  unsigned width = 1280, height = 720;  //!< [px]

  /** Pictures are rendered larger and scaled down: OpenGL draws lines without smoothing. */
  static constexpr unsigned kOversampling = 2;

  static constexpr unsigned kSmallestSide = 16, kLargestSide = 4096;  //!< [px]

  double aspect() const { return static_cast<double>(width) / height; }
  bool isValid() const  //!< Both sides within the bounds
  {
    return std::min(width, height) >= kSmallestSide && std::max(width, height) <= kLargestSide;
  }
};

/** Moves `view` along and across its direction until all points fit into the picture tightly.
 * \param aspect Width of the picture / its height.
 * \param margin Free part of the picture on each side, in [0, 0.5). */
ViewPoint framed(
    ViewPoint view, const std::vector<Eigen::Vector3d>& points, double aspect, double margin);

}  // namespace quadmap
