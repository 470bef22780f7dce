#include "quadmap/geometry/Support.h"

namespace quadmap
{
SupportWithDerivatives supportWithDerivatives(
    const Eigen::Vector3d& n_obj, const Eigen::Vector3d& s, double q)
{
  const Eigen::Vector3d v = n_obj.cwiseProduct(s);
  if (q == 2.0)
  {
    const double h = v.norm();
    return {h, v.cwiseProduct(s) / h, v.cwiseProduct(n_obj) / h};
  }
  // doc/mathematics.md, (3.2) to (3.4): h = S^(1/q), S = sum w_i^(q/2), w_i = v_i^2 + k^2.
  constexpr double smoothing2 = kSupportSmoothing * kSupportSmoothing;
  const Eigen::Array3d w = v.array().square() + smoothing2 * s.squaredNorm();
  const Eigen::Array3d powers = w.pow(0.5 * q);
  const double S = powers.sum();
  const double h = std::pow(S, 1.0 / q);
  const Eigen::Array3d dh_dw = 0.5 * h / S * powers / w;
  const Eigen::Array3d dh_dv = dh_dw * 2.0 * v.array();
  const double dh_dk2 = dh_dw.sum();
  return {h, dh_dv * s.array(), dh_dv * n_obj.array() + dh_dk2 * 2.0 * smoothing2 * s.array()};
}

double tangencyResidual(const Plane& plane, const Ellipsoid& object, double q)
{
  const Eigen::Vector3d n_obj = object.rotation().transpose() * plane.n;
  return plane.signedDistance(object.center()) -
         supportFunction<double>(n_obj, object.semiAxes(), q);
}

}  // namespace quadmap
