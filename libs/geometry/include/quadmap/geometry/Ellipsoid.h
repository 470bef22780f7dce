#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>

namespace quadmap
{
/** One object as a solid ellipsoid, and its circumscribed cuboid, whose half sizes are the
 * semi-axes. It is a value: cheap to copy and never invalid.
 *
 * Frame `obj`: origin at the centre, axes along the semi-axes (a, b, c), z the up axis of the
 * object's support. A point (x, y, z) [m] of that frame is inside the ellipsoid when
 * (x/a)^2 + (y/b)^2 + (z/c)^2 <= 1: doc/mathematics.md, (1.1). The reference frame (`ref`) is the
 * map's unless a name says otherwise. */
class Ellipsoid
{
 public:
  /** A sphere of radius 1 m at the origin. */
  Ellipsoid();

  /** \param T_ref_obj Pose of `obj` in the reference frame.
   *  \param semiAxes Half lengths (a, b, c) [m].
   *  \exception std::invalid_argument If a half length is not finite and positive, or the pose is
   *  not finite. */
  Ellipsoid(const mrpt::poses::CPose3D& T_ref_obj, const Eigen::Vector3d& semiAxes);

  const mrpt::poses::CPose3D& pose() const { return pose_; }     //!< T_ref_obj
  const Eigen::Vector3d& semiAxes() const { return semiAxes_; }  //!< (a, b, c) [m]
  Eigen::Vector3d center() const;                                //!< In the reference frame [m]
  Eigen::Matrix3d rotation() const;  //!< R_ref_obj; its columns are the object's axes
  double cuboidVolume() const { return 8.0 * semiAxes_.prod(); }  //!< [m^3]

  /** The eight corners of the circumscribed cuboid in the reference frame, one per column [m].
   *  Column i has the signs of its bits: bit 0 = +x, bit 1 = +y, bit 2 = +z. */
  Eigen::Matrix<double, 3, 8> cuboidCorners() const;

  /** D = R diag(a^2, b^2, c^2) R^t [m^2]: doc/mathematics.md, (1.2). The half width of the
   * ellipsoid along a unit vector n is sqrt(n^t D n). */
  Eigen::Matrix3d shapeMatrix() const;

  /** Dual quadric, 4x4 symmetric: Q* = T diag(a^2, b^2, c^2, -1) T^t, where T is the 4x4 matrix of
   *  the pose. A plane pi (4x1) touches the surface when pi^t Q* pi = 0: doc/mathematics.md, (1.2)
   *  and (1.3). */
  Eigen::Matrix4d dualQuadric() const;

  /** The same object expressed in another frame. \param T_new_ref Pose of `ref` in that frame. */
  Ellipsoid transformed(const mrpt::poses::CPose3D& T_new_ref) const;

 private:
  mrpt::poses::CPose3D pose_;
  Eigen::Vector3d semiAxes_;
};

}  // namespace quadmap
