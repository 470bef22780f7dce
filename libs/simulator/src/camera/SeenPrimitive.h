#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <algorithm>

#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/simulator/Primitive.h"

namespace quadmap::simulator
{
/** A pose as a matrix and a vector, which is quick to apply. */
struct Transform
{
  Eigen::Matrix3d R;
  Eigen::Vector3d t;

  explicit Transform(const mrpt::poses::CPose3D& pose) :
      R(pose.getRotationMatrix().asEigen()), t(pose.x(), pose.y(), pose.z())
  {
  }
  Eigen::Vector3d inverted(const Eigen::Vector3d& p) const { return R.transpose() * (p - t); }
};

/** The pixels [u1, u2) x [v1, v2), which may be outside the image. */
struct PixelRect
{
  int u1 = 0, v1 = 0, u2 = 0, v2 = 0;

  PixelRect clipped(const PixelRect& to) const
  {
    PixelRect r{std::max(u1, to.u1), std::max(v1, to.v1), std::min(u2, to.u2), std::min(v2, to.v2)};
    r.u2 = std::max(r.u1, r.u2);
    r.v2 = std::max(r.v1, r.v2);
    return r;
  }
  bool contains(int u, int v) const { return u >= u1 && u < u2 && v >= v1 && v < v2; }
};

/** A primitive as one camera sees it. In `prim`, rays start at `o` with the direction D * (u, v,
 * 1). The optical z of this direction is 1, so that the parameter of the ray is the depth. */
struct SeenPrimitive
{
  const Primitive* primitive;
  Eigen::Vector3d o;
  Eigen::Matrix3d D;
  PixelRect rect;  // encloses the projection, not clipped to the image

  Eigen::Vector3d direction(int u, int v) const { return D * Eigen::Vector3d(u, v, 1); }
};

/** The matrix that turns pixels (u, v, 1) into directions with z = 1 in `optical`. */
Eigen::Matrix3d inverseOf(const PinholeCamera& camera);

/** Pixels that enclose the projection of the primitive, up to one image size beyond the border.
 * They are all of these when a part of the primitive is behind the camera. */
PixelRect boundsOf(const SeenPrimitive& seen, const PinholeCamera& camera);

}  // namespace quadmap::simulator
