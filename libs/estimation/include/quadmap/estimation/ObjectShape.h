#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "quadmap/estimation/MapObject.h"

namespace quadmap
{
/** The rotations that an object may have. */
enum class ObjectFreedom
{
  Upright,  //!< It stands on a support and turns about the vertical alone: 7 numbers.
  Free      //!< Its support is not known and it turns about all axes: 9 numbers.
};

/** An object as the residuals see it, in the map (doc/mathematics.md, (1.1) and (1.4)). */
struct ObjectShape
{
  explicit ObjectShape(const UprightState& x) :
      freedom(ObjectFreedom::Upright), t(x.head<3>()), s(x.tail<3>().array().exp()), yaw(x[3])
  {
    const double cosine = std::cos(yaw), sine = std::sin(yaw);
    R << cosine, -sine, 0, sine, cosine, 0, 0, 0, 1;
  }
  ObjectShape(
      const Eigen::Vector3d& center,
      const Eigen::Matrix3d& rotation,
      const Eigen::Vector3d& semiAxes) :
      freedom(ObjectFreedom::Free), t(center), R(rotation), s(semiAxes)
  {
  }

  ObjectFreedom freedom;
  Eigen::Vector3d t;  //!< Centre [m]
  Eigen::Matrix3d R;  //!< Axes of the object, one per column
  Eigen::Vector3d s;  //!< Semi-axes [m]
  double yaw = 0;     //!< Of an upright object [rad]
};

}  // namespace quadmap
