#include "camera/Silhouette.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadmap::simulator
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNear = 0.01;     // nearer parts do not count [m]
constexpr int kPrismSides = 512;   // of the prism in place of a cylinder that crosses kNear
constexpr double kTangent = 1e-9;  // relative discriminant of a tangent

/** A box that grows by points and solids. Points are given as h = K p_optical = (u z, v z, z). */
class OutlineBounds
{
 public:
  void addSegment(Vector3d p, Vector3d q)
  {
    if (p.z() > q.z()) std::swap(p, q);
    if (q.z() < kNear) return;
    if (p.z() < kNear) p += (q - p) * ((kNear - p.z()) / (q.z() - p.z()));
    addCoordinate(0, p.x() / p.z());
    addCoordinate(1, p.y() / p.z());
    addCoordinate(0, q.x() / q.z());
    addCoordinate(1, q.y() / q.z());
  }

  /** Adds the points c + A s with |s| <= 1. They are an ellipsoid (three columns) or an elliptic
   * disc (two columns). The box ends where a plane u = k or v = k touches it, or at the near plane.
   */
  template <typename Axes>
  void addRound(const Vector3d& c, const Axes& A)
  {
    for (int row = 0; row < 2; ++row)
    {
      // With n = e_row - k e_z, (n . c)^2 = |A^t n|^2 is a quadratic equation in k.
      const double a = c.z() * c.z() - A.row(2).squaredNorm();
      const double b = c.z() * c[row] - A.row(2).dot(A.row(row));
      const double d = c[row] * c[row] - A.row(row).squaredNorm();
      const double discriminant = b * b - a * d;
      if (discriminant < -kTangent * (b * b + std::abs(a * d))) continue;
      const double root = std::sqrt(std::max(0.0, discriminant));
      for (const double k : {(b - root) / a, (b + root) / a})
        if (std::isfinite(k) && touchesInFront(c, A, row, k)) addCoordinate(row, k);
    }
    addSection(c, A);
  }

  std::optional<ImageBox> box() const
  {
    if (low_[0] > high_[0]) return std::nullopt;
    return ImageBox{low_[0], low_[1], high_[0], high_[1]};
  }

 private:
  void addCoordinate(int row, double k)
  {
    low_[row] = std::min(low_[row], k);
    high_[row] = std::max(high_[row], k);
  }

  template <typename Axes>
  static bool touchesInFront(const Vector3d& c, const Axes& A, int row, double k)
  {
    const Vector3d n = Vector3d::Unit(row) - k * Vector3d::UnitZ();
    const auto g = (A.transpose() * n).eval();
    const double length = g.norm();
    if (length == 0) return c.z() >= kNear;  // the plane contains the disc
    return c.z() - std::copysign(1.0, n.dot(c)) * A.row(2).dot(g) / length >= kNear;
  }

  /** Adds the slice at z = kNear, if there is one. */
  template <typename Axes>
  void addSection(const Vector3d& c, const Axes& A)
  {
    const auto w = A.row(2).transpose().eval();
    const double ww = w.squaredNorm(), rise = kNear - c.z();
    if (ww == 0 || rise * rise >= ww) return;
    const double radius = std::sqrt(1 - rise * rise / ww);
    for (int row = 0; row < 2; ++row)
    {
      const auto g = A.row(row).transpose().eval();
      const double middle = c[row] + g.dot(w) * rise / ww;
      const double reach = radius * (g - w * (g.dot(w) / ww)).norm();
      addCoordinate(row, (middle - reach) / kNear);
      addCoordinate(row, (middle + reach) / kNear);
    }
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low_[2] = {kInfinity, kInfinity};
  double high_[2] = {-kInfinity, -kInfinity};
};

/** Adds a cuboid. \param A Its columns are the half axes. */
void addBox(OutlineBounds& bounds, const Vector3d& c, const Matrix3d& A)
{
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner)
    {
      const Vector3d side = A.col((axis + 1) % 3) * ((corner & 1) ? 1 : -1) +
                            A.col((axis + 2) % 3) * ((corner & 2) ? 1 : -1);
      bounds.addSegment(c + side - A.col(axis), c + side + A.col(axis));
    }
}

void addCylinder(OutlineBounds& bounds, const Vector3d& c, const Matrix3d& A)
{
  const double nearest = c.z() - std::abs(A(2, 2)) - A.row(2).head<2>().norm();
  if (nearest >= kNear)  // the hull of its two caps
  {
    bounds.addRound(c - A.col(2), A.leftCols<2>());
    bounds.addRound(c + A.col(2), A.leftCols<2>());
    return;
  }
  Vector3d last = A.col(0);
  for (int i = 1; i <= kPrismSides; ++i)
  {
    const double angle = 2 * M_PI * i / kPrismSides;
    const Vector3d next = std::cos(angle) * A.col(0) + std::sin(angle) * A.col(1);
    bounds.addSegment(c + next - A.col(2), c + next + A.col(2));
    for (const double end : {-1.0, 1.0})
      bounds.addSegment(c + last + end * A.col(2), c + next + end * A.col(2));
    last = next;
  }
}

void addSolid(
    OutlineBounds& bounds,
    const Primitive& solid,
    const mrpt::poses::CPose3D& T_camera_prim,
    const PinholeCamera& camera)
{
  const mrpt::poses::CPose3D T_optical_prim = T_camera_prim - T_sensor_optical();
  const Matrix3d K = camera.matrix();
  const Vector3d c = K * Vector3d(T_optical_prim.x(), T_optical_prim.y(), T_optical_prim.z());
  const Matrix3d A = K * T_optical_prim.getRotationMatrix().asEigen() * solid.halfSize.asDiagonal();
  switch (solid.shape)
  {
    case Shape::Box:
      return addBox(bounds, c, A);
    case Shape::Cylinder:
      return addCylinder(bounds, c, A);
    case Shape::Ellipsoid:
      return bounds.addRound(c, A);
  }
}

}  // namespace

std::optional<ImageBox> outlineBox(
    const Primitive& solid, const mrpt::poses::CPose3D& T_camera_prim, const PinholeCamera& camera)
{
  OutlineBounds bounds;
  addSolid(bounds, solid, T_camera_prim, camera);
  return bounds.box();
}

std::optional<ImageBox> outlineBox(
    const SceneObject& object,
    const mrpt::poses::CPose3D& T_camera_obj,
    const PinholeCamera& camera)
{
  OutlineBounds bounds;
  for (const auto& part : object.parts)
    addSolid(bounds, part, T_camera_obj + part.T_obj_prim, camera);
  return bounds.box();
}

}  // namespace quadmap::simulator
