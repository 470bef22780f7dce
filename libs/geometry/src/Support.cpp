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
  // doc/mathematics.md, (3.3) and (3.4)
  const SupportSum<double> sum(v, s, q);
  const Eigen::Array3d dh_dw = 0.5 * sum.h / sum.S * sum.powers / sum.w;
  const Eigen::Array3d dh_dv = dh_dw * 2.0 * v.array();
  constexpr double smoothing2 = kSupportSmoothing * kSupportSmoothing;
  return {
      sum.h, dh_dv * s.array(), dh_dv * n_obj.array() + dh_dw.sum() * 2.0 * smoothing2 * s.array()};
}

}  // namespace quadmap
