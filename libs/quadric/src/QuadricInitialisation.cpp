#include "quadmap/quadric/QuadricInitialisation.h"

#include <algorithm>
#include <cmath>

#include "quadmap/estimation/LabelPrior.h"
#include "quadmap/estimation/ResidualRow.h"

namespace quadmap
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

constexpr std::size_t kMinBoxes = 3;
constexpr std::size_t kMinEdges = 9;  //!< Q* has ten numbers, and its scale means nothing

/** The second smallest singular value of the system, as a share of the largest: below it the
 * smallest one does not stand alone, and the edges leave several Q*. Views from one place give 0.
 */
constexpr double kMinSingularShare = 1e-4;

std::vector<Plane> usableEdges(const std::vector<PlacedBox>& boxes)
{
  std::vector<Plane> planes;
  for (const auto& box : boxes)
    for (std::size_t e = 0; e < box.edges.size(); ++e)
      if (box.usable[e]) planes.push_back(box.edges[e]);
  return planes;
}

/** The smallest singular vector of the stacked rows pi^t Q* pi = 0 as a symmetric matrix,
 * doc/mathematics.md, (17.8). */
std::optional<Matrix4d> dualQuadricTouching(const std::vector<Plane>& planes)
{
  Eigen::MatrixXd A(static_cast<Eigen::Index>(planes.size()), 10);
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    const Eigen::Vector4d p(planes[i].n.x(), planes[i].n.y(), planes[i].n.z(), planes[i].d);
    Eigen::Index column = 0;
    for (Eigen::Index a = 0; a < 4; ++a)
      for (Eigen::Index b = a; b < 4; ++b)
        A(static_cast<Eigen::Index>(i), column++) = (a == b ? 1 : 2) * p[a] * p[b];
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
  const Eigen::VectorXd& s = svd.singularValues();
  if (s[8] < kMinSingularShare * s[0]) return std::nullopt;
  const Eigen::VectorXd q = svd.matrixV().col(9);
  Matrix4d Q;
  Eigen::Index entry = 0;
  for (Eigen::Index a = 0; a < 4; ++a)
    for (Eigen::Index b = a; b < 4; ++b) Q(a, b) = Q(b, a) = q[entry++];
  return Q;
}

/** The ellipsoid with Q* = T diag(a^2, b^2, c^2, -1) T^t, doc/mathematics.md, (17.9). Q* may have
 * any scale. */
std::optional<Ellipsoid> ellipsoidOfDual(const Matrix4d& Q)
{
  if (std::abs(Q(3, 3)) < 1e-12 * Q.cwiseAbs().maxCoeff()) return std::nullopt;
  const Matrix4d scaled = Q / -Q(3, 3);
  const Vector3d t = -scaled.topRightCorner<3, 1>();
  const Matrix3d D = scaled.topLeftCorner<3, 3>() + t * t.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(D);
  if (!(eigen.eigenvalues().minCoeff() > 0)) return std::nullopt;
  Matrix3d R = eigen.eigenvectors();
  if (R.determinant() < 0) R.col(0) *= -1;
  Eigen::Matrix4d T = Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = R;
  T.topRightCorner<3, 1>() = t;
  return Ellipsoid(
      mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T)), eigen.eigenvalues().cwiseSqrt());
}

}  // namespace

Vector3d PlacedBox::forward() const
{
  Vector3d sum = Vector3d::Zero();
  for (const auto& edge : edges) sum += edge.n;
  return sum.normalized();
}

std::vector<Vector3d> camerasOf(const std::vector<PlacedBox>& boxes)
{
  std::vector<Vector3d> cameras;
  for (const auto& box : boxes) cameras.push_back(box.camera);
  return cameras;
}

/** The least-squares solution is (17.7) of doc/mathematics.md. */
std::optional<Vector3d> triangulatedCenter(const std::vector<PlacedBox>& boxes)
{
  Matrix3d H = Matrix3d::Zero();
  Vector3d g = Vector3d::Zero();
  for (const auto& box : boxes)
    for (const std::size_t e : {0, 1})  // left with right, top with bottom
    {
      if (!box.usable[e] || !box.usable[e + 2]) continue;
      const Vector3d m = (box.edges[e].n - box.edges[e + 2].n).normalized();
      H += m * m.transpose();
      g += m * m.dot(box.camera);
    }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(H);
  constexpr double kMinShare = 1e-5;  // of the eigenvalues: rays within 0.2 degrees are parallel
  if (!(eigen.eigenvalues()[0] > kMinShare * eigen.eigenvalues()[2])) return std::nullopt;
  return Vector3d(H.ldlt().solve(g));
}

std::optional<Ellipsoid> ellipsoidTouching(const std::vector<PlacedBox>& boxes)
{
  std::vector<Plane> planes = usableEdges(boxes);
  if (boxes.size() < kMinBoxes || planes.size() < kMinEdges) return std::nullopt;
  const auto center = triangulatedCenter(boxes);
  if (!center) return std::nullopt;
  // The numbers are of like size when the origin is near the object and its size is the unit of
  // length.
  double squares = 0;
  for (Plane& plane : planes)
  {
    plane.d = plane.signedDistance(*center);
    squares += plane.d * plane.d / static_cast<double>(planes.size());
  }
  const double unit = std::sqrt(squares);
  if (!(unit > 0)) return std::nullopt;
  for (Plane& plane : planes) plane.d /= unit;
  const auto Q = dualQuadricTouching(planes);
  const auto scaled = Q ? ellipsoidOfDual(*Q) : std::nullopt;
  if (!scaled) return std::nullopt;
  const Vector3d t = *center + unit * scaled->center();
  mrpt::poses::CPose3D pose = scaled->pose();
  pose.x(t.x());
  pose.y(t.y());
  pose.z(t.z());
  return withAxesNamedUpright(Ellipsoid(pose, unit * scaled->semiAxes())).object;
}

RenamedAxes withAxesNamedUpright(const Ellipsoid& object)
{
  const Matrix3d R = object.rotation();
  Eigen::Index up = 0;
  R.row(2).cwiseAbs().maxCoeff(&up);
  const Eigen::Index x = (up + 1) % 3, y = (up + 2) % 3;
  Eigen::Matrix4d T = Matrix4d::Identity();
  T.block<3, 1>(0, 2) = R(2, up) < 0 ? Vector3d(-R.col(up)) : Vector3d(R.col(up));
  T.block<3, 1>(0, 0) = R.col(x);
  T.block<3, 1>(0, 1) = T.block<3, 1>(0, 2).cross(T.block<3, 1>(0, 0));  // y, or the other way
  T.block<3, 1>(0, 3) = object.center();
  const Vector3d s = object.semiAxes();
  return {
      Ellipsoid(mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T)), Vector3d(s[x], s[y], s[up])),
      {x, y, up}
  };
}

bool isPlausible(
    const Ellipsoid& object,
    const std::vector<PlacedBox>& boxes,
    const LabelProperties& label,
    double maxSizeDeviation)
{
  if (sizeDeviation(object, label, ObjectFreedom::Free) > maxSizeDeviation) return false;
  return std::all_of(
      boxes.begin(), boxes.end(),
      [&](const PlacedBox& box)
      { return tangencyResidual(Plane::throughPoint(box.forward(), box.camera), object) > 0; });
}

}  // namespace quadmap
