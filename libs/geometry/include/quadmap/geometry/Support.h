#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/geometry/Plane.h"

namespace quadmap
{
/** Smoothing of |x| as sqrt(x^2 + k^2): k is this times |s| [-]. */
constexpr double kSupportSmoothing = 1e-3;

/** Support function, the half width of an object along a direction: doc/mathematics.md, (3.1) and
 * (3.2).
 *
 *   h_q(n) = ( sum_i |s_i n_i|^q )^(1/q),   1 <= q <= 2
 *
 * q = 2 is the ellipsoid and q = 1 the circumscribed cuboid. |.| is smoothed near zero, so that
 * derivatives exist everywhere.
 * \tparam T double or an automatic-differentiation scalar.
 * \param n_obj Unit direction in the object's frame. \param s Semi-axes [m]. \return [m]. */
template <typename T>
T supportFunction(const Eigen::Matrix<T, 3, 1>& n_obj, const Eigen::Matrix<T, 3, 1>& s, double q);

/** The support function with its derivatives: doc/mathematics.md, (3.3) and (3.4). */
struct SupportWithDerivatives
{
  double h = 0;         //!< [m]
  Eigen::Vector3d d_n;  //!< dh/dn_obj [m]
  Eigen::Vector3d d_s;  //!< dh/ds [-]
};
SupportWithDerivatives supportWithDerivatives(
    const Eigen::Vector3d& n_obj, const Eigen::Vector3d& s, double q);

/** Signed distance between a plane and the object it should touch, r = (n.t + d) - h_q(n) [m]:
 * doc/mathematics.md, (3.5). It is positive when there is a gap and negative when the plane cuts
 * the object. Plane and object are in one frame, and the plane's normal points towards the object.
 */
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
