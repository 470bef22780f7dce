#include "quadmap/geometry/Projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadmap
{
namespace
{
/** An object nearer to the camera plane than this has no finite outline [m]: doc/mathematics.md,
 * (2.3). */
constexpr double kMinimumGap = 1e-6;

/** A box that grows while points are added. It is not valid before the first one. */
struct Bounds
{
  ImageBox box{
      std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
      -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(const Eigen::Vector2d& pixel)
  {
    box.x1 = std::min(box.x1, pixel.x());
    box.y1 = std::min(box.y1, pixel.y());
    box.x2 = std::max(box.x2, pixel.x());
    box.y2 = std::max(box.y2, pixel.y());
  }
};

/** Both ends of the outline along one axis of the plane z = 1: doc/mathematics.md, (2.2). They are
 * the roots u of
 *
 *   M_zz u^2 - 2 M_iz u + M_ii = 0,   M = D - t t^t (the dual conic for K = I).
 *
 * The discriminant is written out in D and t, so that the terms in t^4 cancel in the formula. */
std::array<double, 2> outlineRange(
    const Eigen::Matrix3d& D, const Eigen::Vector3d& t, Eigen::Index axis)
{
  const double a = D(2, 2) - t.z() * t.z(), b = D(axis, 2) - t(axis) * t.z();
  const double discriminant = D(axis, axis) * t.z() * t.z() - 2 * D(axis, 2) * t(axis) * t.z() +
                              D(2, 2) * t(axis) * t(axis) -
                              (D(axis, axis) * D(2, 2) - D(axis, 2) * D(axis, 2));
  const double root = std::sqrt(std::max(0.0, discriminant));
  return {(b + root) / a, (b - root) / a};
}
}  // namespace

Eigen::Matrix3d projectDualConic(const PinholeCamera& camera, const Ellipsoid& object_optical)
{
  const Eigen::Matrix3d K = camera.matrix();
  return K * object_optical.dualQuadric().topLeftCorner<3, 3>() * K.transpose();
}

std::optional<ImageBox> projectEllipsoidBox(
    const PinholeCamera& camera, const Ellipsoid& object_optical)
{
  const Eigen::Matrix3d D = object_optical.shapeMatrix();
  const Eigen::Vector3d t = object_optical.center();
  const double depthHalfWidth = std::sqrt(D(2, 2));  // h_2 along the optical axis
  if (!(t.z() - depthHalfWidth > kMinimumGap)) return std::nullopt;

  const auto u = outlineRange(D, t, 0), v = outlineRange(D, t, 1);
  Bounds bounds;
  for (std::size_t i = 0; i < 2; ++i)
    bounds.add({camera.fx * u[i] + camera.cx, camera.fy * v[i] + camera.cy});
  if (!bounds.box.isValid()) return std::nullopt;
  return bounds.box;
}

std::optional<ImageBox> projectCuboidBox(
    const PinholeCamera& camera, const Ellipsoid& object_optical, double nearPlane)
{
  const auto corners = object_optical.cuboidCorners();
  Bounds bounds;
  for (int i = 0; i < 8; ++i)
  {
    const Eigen::Vector3d a = corners.col(i);
    if (a.z() >= nearPlane) bounds.add(camera.project(a));
    for (int bit = 1; bit < 8; bit <<= 1)  // the edges from corner i along +x, +y, +z
    {
      if (i & bit) continue;
      const Eigen::Vector3d b = corners.col(i | bit);
      if ((a.z() < nearPlane) == (b.z() < nearPlane)) continue;
      const Eigen::Vector3d p = a + (nearPlane - a.z()) / (b.z() - a.z()) * (b - a);
      bounds.add(camera.project({p.x(), p.y(), nearPlane}));
    }
  }
  if (!bounds.box.isValid()) return std::nullopt;
  return bounds.box;
}

Plane boxEdgePlane(const PinholeCamera& camera, const ImageBox& box, BoxEdge edge)
{
  // doc/mathematics.md, (2.4): (x, y, z) with z > 0 is right of u = x1 if fx x + (cx - x1) z > 0.
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  switch (edge)
  {
    case BoxEdge::Left:
      n = {camera.fx, 0, camera.cx - box.x1};
      break;
    case BoxEdge::Top:
      n = {0, camera.fy, camera.cy - box.y1};
      break;
    case BoxEdge::Right:
      n = {-camera.fx, 0, box.x2 - camera.cx};
      break;
    case BoxEdge::Bottom:
      n = {0, -camera.fy, box.y2 - camera.cy};
      break;
  }
  return {n.normalized(), 0.0};
}

std::array<Plane, 4> boxEdgePlanes(const PinholeCamera& camera, const ImageBox& box)
{
  return {
      boxEdgePlane(camera, box, BoxEdge::Left), boxEdgePlane(camera, box, BoxEdge::Top),
      boxEdgePlane(camera, box, BoxEdge::Right), boxEdgePlane(camera, box, BoxEdge::Bottom)};
}

}  // namespace quadmap
