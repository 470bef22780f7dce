#include "quadmap/geometry/RotationDistance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace quadmap
{
namespace
{
/** The 24 signed permutations with determinant +1: the rotations that map a cube onto itself. */
std::array<Eigen::Matrix3d, 24> properRelabelings()
{
  std::array<Eigen::Matrix3d, 24> all;
  std::size_t count = 0;
  std::array<int, 3> axes{0, 1, 2};
  do
    for (int signs = 0; signs < 8; ++signs)
    {
      Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) P(axes[std::size_t(i)], i) = (signs >> i & 1) ? -1 : 1;
      if (P.determinant() > 0) all[count++] = P;
    }
  while (std::next_permutation(axes.begin(), axes.end()));
  return all;
}

/** Angle between two rotations, from |A - B|_F = 2 sqrt(2) sin(angle / 2), which is exact for small
 * angles too: doc/mathematics.md, (20.4). */
double angleBetween(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B)
{
  return 2 * std::asin(std::min(1.0, (A - B).norm() / (2 * std::sqrt(2.0))));
}
}  // namespace

SymmetricRotation symmetricRotationDistance(const Eigen::Matrix3d& R_a, const Eigen::Matrix3d& R_b)
{
  static const auto relabelings = properRelabelings();
  SymmetricRotation best{std::numeric_limits<double>::infinity(), Eigen::Matrix3d::Identity()};
  for (const Eigen::Matrix3d& P : relabelings)
  {
    const double angle = angleBetween(R_a, R_b * P);
    if (angle < best.angle) best = {angle, P};
  }
  return best;
}

double yawDistance(double yawA, double yawB, double period)
{
  return std::abs(std::remainder(yawA - yawB, period));
}

int quarterTurnsTo(double yaw, double reference)
{
  return static_cast<int>(std::lround((nearestEquivalentYaw(yaw, reference) - yaw) / (M_PI / 2)));
}

double nearestEquivalentYaw(double yaw, double reference, double period)
{
  return reference + std::remainder(yaw - reference, period);
}

}  // namespace quadmap
