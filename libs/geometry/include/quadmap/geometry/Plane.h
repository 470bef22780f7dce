#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>

namespace quadmap
{
/** Plane n.x + d = 0 with the unit normal n and the distance d [m]. Where a plane bounds an object,
 * n points towards the object. */
struct Plane
{
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  double d = 0;

  double signedDistance(const Eigen::Vector3d& p) const { return n.dot(p) + d; }  //!< [m]

  /** The plane of frame b expressed in frame a. */
  Plane transformed(const mrpt::poses::CPose3D& T_a_b) const;

  static Plane throughPoint(const Eigen::Vector3d& unitNormal, const Eigen::Vector3d& p)
  {
    return {unitNormal, -unitNormal.dot(p)};
  }
};

}  // namespace quadmap
