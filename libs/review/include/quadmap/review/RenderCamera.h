#pragma once

#include <mrpt/opengl/CCamera.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

namespace quadmap
{
/** The camera that renders a scene: MRPT's orbit camera, projective, in a z-up map. */
struct RenderCamera
{
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  //!< Point in the middle of the picture [m]
  double distance = 10.0;                            //!< Distance from target to eye [m], > 0
  double azimuth = 0;        //!< Direction from target to eye, from x towards y [rad]
  double elevation = 0;      //!< Angle of the eye above the horizontal plane [rad]
  double verticalFov = 0.5;  //!< Full opening angle of the picture's height [rad]

  Eigen::Vector3d toEye() const;  //!< Unit vector from the target to the eye
  Eigen::Vector3d eye() const { return target + distance * toEye(); }
  /** Axes of the picture in the map. The columns are right, up and towards the eye. */
  Eigen::Matrix3d axes() const;

  void applyTo(mrpt::opengl::CCamera& camera) const;
};

/** Size of a rendered picture. */
struct PictureSize
{
  unsigned width = 1280, height = 720;  //!< [px]

  /** Pictures are rendered so many times larger and scaled down, because OpenGL draws lines without
   * smoothing. */
  static constexpr unsigned kOversampling = 2;

  static constexpr unsigned kSmallestSide = 16, kLargestSide = 4096;  //!< [px]

  double aspect() const { return static_cast<double>(width) / height; }
  bool isValid() const  //!< Whether both sides are within the bounds
  {
    return std::min(width, height) >= kSmallestSide && std::max(width, height) <= kLargestSide;
  }
};

/** Moves the camera along and across its direction until all points fit tightly into the picture.
 * \param aspect Width of the picture / its height.
 * \param margin Free part of the picture on each side, in [0, 0.5). */
RenderCamera framed(
    RenderCamera camera, const std::vector<Eigen::Vector3d>& points, double aspect, double margin);

}  // namespace quadmap
