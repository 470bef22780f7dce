#pragma once

#include <Eigen/Dense>

#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
/** A pose as a rotation (a quaternion, or an angle in the plane) and a translation [m]. */
template <typename Rotation, typename Translation>
struct RotationAndTranslation
{
  Rotation R;
  Translation t;
};

template <typename T>
Eigen::Quaternion<T> reversed(const Eigen::Quaternion<T>& unit)
{
  return unit.conjugate();
}
template <typename T>
Eigen::Rotation2D<T> reversed(const Eigen::Rotation2D<T>& R)
{
  return R.inverse();
}

/** How far two poses are from a measured step between them, before it is whitened:
 * [R_f^t (t_t - t_f) - t_m; log(R_m^t R_f^t R_t)], doc/mathematics.md, (16.2). The position's error
 * is along the axes of `from` and the turn's along those of `to`.
 * \tparam Rotation, Translation Of double or of an automatic-differentiation scalar, in the plane
 * (three numbers) or in space (six). \tparam MeasuredRotation, MeasuredTranslation Those of double.
 */
template <
    typename Rotation,
    typename Translation,
    typename MeasuredRotation,
    typename MeasuredTranslation>
auto stepResidual(
    const RotationAndTranslation<Rotation, Translation>& from,
    const RotationAndTranslation<Rotation, Translation>& to,
    const RotationAndTranslation<MeasuredRotation, MeasuredTranslation>& measured)
{
  using T = typename Translation::Scalar;
  constexpr int kDimension = Translation::RowsAtCompileTime;
  constexpr int kTurn = kDimension == 2 ? 1 : 3;
  const Rotation R_from_to = reversed(from.R) * to.R;
  Eigen::Matrix<T, kDimension + kTurn, 1> e;
  e.template head<kDimension>() =
      reversed(from.R) * Translation(to.t - from.t) - measured.t.template cast<T>();
  e.template tail<kTurn>() =
      rotationVectorOf(Rotation(reversed(measured.R).template cast<T>() * R_from_to));
  return e;
}

}  // namespace quadmap
