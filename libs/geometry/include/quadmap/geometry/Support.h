#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/geometry/Plane.h"

namespace quadmap
{
/** Where |x| is replaced by sqrt(x^2 + k^2) - smooth at zero: k = this * |s|. */
constexpr double kSupportSmoothing = 1e-3;

/** Half width of an object along a direction, from the family of doc/mathematics.md
 *
 *   h_q(n) = ( sum_i |s_i n_i|^q )^(1/q),   1 <= q <= 2,
 *
 * q = 2 the ellipsoid, q = 1 the circumscribed cuboid. |.| is smoothed near zero so that
 * derivatives exist everywhere.
 * \tparam T double or an automatic-differentiation scalar.
 * \param n_obj Unit direction in the object's frame. \param s Semi-axes [m]. \return [m]. */
template <typename T>
T supportFunction(const Eigen::Matrix<T, 3, 1>& n_obj, const Eigen::Matrix<T, 3, 1>& s, double q);

/** h_q with its derivatives. */
struct SupportWithDerivatives
{
  double h = 0;         //!< [m]
  Eigen::Vector3d d_n;  //!< dh/dn_obj [m]
  Eigen::Vector3d d_s;  //!< dh/ds [-]
};
SupportWithDerivatives supportWithDerivatives(
    const Eigen::Vector3d& n_obj, const Eigen::Vector3d& s, double q);

/** Signed distance between a plane and the object it should touch, r = (n.t + d) - h_q(n) [m]:
 * positive when there is a gap, negative when the plane cuts. Plane and object in one frame, the
 * plane's normal towards the object (doc/mathematics.md). */
double tangencyResidual(const Plane& plane, const Ellipsoid& object, double q = 2.0);

// ---------------------------------------------------------------------------------------------

template <typename T>
T supportFunction(const Eigen::Matrix<T, 3, 1>& n_obj, const Eigen::Matrix<T, 3, 1>& s, double q)
{
  using std::pow;
  using std::sqrt;
  if (q == 2.0) return n_obj.cwiseProduct(s).norm();
  const Eigen::Matrix<T, 3, 1> v = n_obj.cwiseProduct(s);
  const T k2 = s.squaredNorm() * T(kSupportSmoothing * kSupportSmoothing);
  T sum(0);
  for (int i = 0; i < 3; ++i) sum += pow(v[i] * v[i] + k2, 0.5 * q);
  return pow(sum, 1.0 / q);
}

}  // namespace quadmap
