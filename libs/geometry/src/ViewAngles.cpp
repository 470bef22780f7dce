#include "quadmap/geometry/ViewAngles.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
double parallax(const Eigen::Vector3d& point, const std::vector<Eigen::Vector3d>& cameras)
{
  double smallestCosine = 1;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
    {
      const Eigen::Vector3d a = point - cameras[i], b = point - cameras[j];
      smallestCosine = std::min(smallestCosine, a.normalized().dot(b.normalized()));
    }
  return std::acos(std::clamp(smallestCosine, -1.0, 1.0));
}

double rangeThatFills(double size, const Eigen::Vector3d& n_a, const Eigen::Vector3d& n_b)
{
  constexpr double kLeastAngle = 1e-3;  // a box without width has no range [rad]
  const double angle = std::acos(std::clamp(-n_a.dot(n_b), -1.0, 1.0));
  return 0.5 * size / std::tan(0.5 * std::max(angle, kLeastAngle));
}

}  // namespace quadmap
