#include "quadmap/estimation/MapObject.h"

#include <cmath>

namespace quadmap
{
UprightState uprightStateOf(const Ellipsoid& object)
{
  UprightState x;
  x.head<3>() = object.center();
  const Eigen::Matrix3d R = object.rotation();
  x[3] = std::atan2(R(1, 0), R(0, 0));
  x.tail<3>() = object.semiAxes().array().log();
  return x;
}

Ellipsoid ellipsoidOf(const UprightState& state)
{
  return Ellipsoid(
      mrpt::poses::CPose3D(state[0], state[1], state[2], state[3], 0.0, 0.0),
      state.tail<3>().array().exp());
}

UprightCovariance covarianceIntersection(const UprightCovariance& a, const UprightCovariance& b)
{
  constexpr int kSteps = 20;  // of the share of a; the optimum is flat
  const UprightCovariance A = a.inverse(), B = b.inverse();
  UprightCovariance best = a;
  double least = best.determinant();
  for (int i = 0; i < kSteps; ++i)
  {
    const double share = static_cast<double>(i) / kSteps;
    const UprightCovariance both = (share * A + (1 - share) * B).inverse();
    const double determinant = both.determinant();
    if (!(determinant < least)) continue;
    least = determinant;
    best = both;
  }
  return 0.5 * (best + best.transpose());
}

bool isPositiveSemidefinite(const UprightCovariance& m, double rounding)
{
  if (!m.allFinite()) return false;
  const double tolerance = rounding * m.cwiseAbs().maxCoeff();
  return (m - m.transpose()).cwiseAbs().maxCoeff() <= tolerance &&
         Eigen::SelfAdjointEigenSolver<UprightCovariance>(m, Eigen::EigenvaluesOnly)
                 .eigenvalues()
                 .minCoeff() >= -tolerance;
}

UprightCovariance withoutNegative(const UprightCovariance& symmetric)
{
  const Eigen::SelfAdjointEigenSolver<UprightCovariance> eigen(symmetric);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

std::string mostFrequentLabel(const std::map<std::string, unsigned>& counts)
{
  std::string best;
  unsigned bestCount = 0;
  for (const auto& [name, count] : counts)
  {
    if (count <= bestCount) continue;
    best = name;
    bestCount = count;
  }
  return best;
}

double MapObject::existence() const { return 1.0 / (1.0 + std::exp(-logOdds())); }

}  // namespace quadmap
