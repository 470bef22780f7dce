#include "quadmap/simulator/Primitive.h"

#include <cmath>
#include <limits>

namespace quadmap::simulator
{
namespace
{
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** The part [near, far] of a ray. It is empty when near > far. */
struct Interval
{
  double near = -kInfinity, far = kInfinity;

  void cut(double a, double b)
  {
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  void makeEmpty() { far = -kInfinity; }
};

/** Cuts the part to |o + t d| <= h in one coordinate. */
void cutSlab(Interval& part, double o, double d, double h)
{
  if (d != 0)
    part.cut((-h - o) / d, (h - o) / d);
  else if (std::abs(o) > h)
    part.makeEmpty();
}

/** Cuts the part to |o + t d|^2 <= 1. */
template <typename Vector>
void cutUnitBall(Interval& part, const Vector& o, const Vector& d)
{
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - 1;
  if (a == 0)
  {
    if (c > 0) part.makeEmpty();
    return;
  }
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return part.makeEmpty();
  const double root = std::sqrt(discriminant);
  part.cut((-b - root) / a, (-b + root) / a);
}

}  // namespace

std::optional<double> intersect(
    const Primitive& primitive, const Eigen::Vector3d& o, const Eigen::Vector3d& d)
{
  const Eigen::Vector3d& h = primitive.halfSize;
  Interval part;
  switch (primitive.shape)
  {
    case Shape::Box:
      for (int i = 0; i < 3; ++i) cutSlab(part, o[i], d[i], h[i]);
      break;
    case Shape::Cylinder:
    {
      cutSlab(part, o.z(), d.z(), h.z());
      const Eigen::Array2d r = h.head<2>().array();
      cutUnitBall<Eigen::Vector2d>(part, o.head<2>().array() / r, d.head<2>().array() / r);
      break;
    }
    case Shape::Ellipsoid:
      cutUnitBall<Eigen::Vector3d>(part, o.cwiseQuotient(h), d.cwiseQuotient(h));
      break;
  }
  if (part.near > part.far || part.near <= 0) return std::nullopt;
  return part.near;
}

Eigen::Vector3d surfaceNormal(const Primitive& primitive, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d s = p.cwiseQuotient(primitive.halfSize);
  const Eigen::Vector3d gradient = s.cwiseQuotient(primitive.halfSize);
  if (primitive.shape == Shape::Ellipsoid) return gradient.normalized();

  if (primitive.shape == Shape::Cylinder && s.head<2>().norm() > std::abs(s.z()))
    return Eigen::Vector3d(gradient.x(), gradient.y(), 0).normalized();

  Eigen::Index axis = 2;
  if (primitive.shape == Shape::Box) s.cwiseAbs().maxCoeff(&axis);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  normal[axis] = s[axis] < 0 ? -1 : 1;
  return normal;
}

Eigen::Vector3d halfExtent(const Primitive& primitive)
{
  const Eigen::Matrix3d R = primitive.T_obj_prim.getRotationMatrix().asEigen();
  const Eigen::Matrix3d scaled = R * primitive.halfSize.asDiagonal();
  switch (primitive.shape)
  {
    case Shape::Box:
      return scaled.cwiseAbs().rowwise().sum();
    case Shape::Cylinder:
      return scaled.leftCols<2>().rowwise().norm() + scaled.col(2).cwiseAbs();
    case Shape::Ellipsoid:
      break;
  }
  return scaled.rowwise().norm();
}

}  // namespace quadmap::simulator
