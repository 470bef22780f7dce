#pragma once

#include <Eigen/Dense>
#include <cmath>

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

// ---------------------------------------------------------------------------------------------

/** The sum of (3.2) for q < 2 with its parts: S = sum_i w_i^(q/2), h_q = S^(1/q). */
template <typename T>
struct SupportSum
{
  /** \param v v_i = s_i n_i [m]. \param s Semi-axes [m]. */
  SupportSum(const Eigen::Matrix<T, 3, 1>& v, const Eigen::Matrix<T, 3, 1>& s, double q)
  {
    using std::pow;
    w = v.array().square() + T(kSupportSmoothing * kSupportSmoothing) * s.squaredNorm();
    for (int i = 0; i < 3; ++i) powers[i] = pow(w[i], 0.5 * q);
    S = powers.sum();
    h = pow(S, 1.0 / q);
  }

  Eigen::Array<T, 3, 1> w, powers;  //!< w_i, and w_i^(q/2)
  T S, h;
};

template <typename T>
T supportFunction(const Eigen::Matrix<T, 3, 1>& n_obj, const Eigen::Matrix<T, 3, 1>& s, double q)
{
  const Eigen::Matrix<T, 3, 1> v = n_obj.cwiseProduct(s);
  return q == 2.0 ? v.norm() : SupportSum<T>(v, s, q).h;
}

}  // namespace quadmap
