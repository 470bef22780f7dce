#include "quadmap/review/RenderCamera.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadmap
{
namespace
{
/** Distance and sideways shift that keep one dimension of the picture inside its two edges.
 *
 * A point at x across and z towards the eye is inside when |x - c| <= (D - z) t, t the tangent of
 * half the opening: D t >= x - c + z t and D t >= -(x - c) + z t for all points. */
struct Fit
{
  double largestPlus = -std::numeric_limits<double>::infinity();   // max of x + z t
  double largestMinus = -std::numeric_limits<double>::infinity();  // max of -x + z t

  void add(double x, double z, double t)
  {
    largestPlus = std::max(largestPlus, x + z * t);
    largestMinus = std::max(largestMinus, -x + z * t);
  }
  double center() const { return 0.5 * (largestPlus - largestMinus); }
  double distance(double t) const { return 0.5 * (largestPlus + largestMinus) / t; }
};

}  // namespace

Eigen::Vector3d RenderCamera::toEye() const
{
  return {
      std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
      std::sin(elevation)};
}

Eigen::Matrix3d RenderCamera::axes() const
{
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d(-std::sin(azimuth), std::cos(azimuth), 0);
  axes.col(2) = toEye();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

void RenderCamera::applyTo(mrpt::opengl::CCamera& camera) const
{
  camera.set6DOFMode(false);
  camera.setProjectiveModel(true);
  camera.setProjectiveFOVdeg(static_cast<float>(mrpt::RAD2DEG(verticalFov)));
  camera.setPointingAt(mrpt::math::TPoint3D(target.x(), target.y(), target.z()));
  camera.setZoomDistance(static_cast<float>(distance));
  camera.setAzimuthDegrees(static_cast<float>(mrpt::RAD2DEG(azimuth)));
  camera.setElevationDegrees(static_cast<float>(mrpt::RAD2DEG(elevation)));
}

RenderCamera framed(
    RenderCamera camera, const std::vector<Eigen::Vector3d>& points, double aspect, double margin)
{
  if (points.empty()) return camera;
  const Eigen::Matrix3d axes = camera.axes();
  const double tanVertical = std::tan(0.5 * camera.verticalFov) * (1 - 2 * margin);
  const double tanHorizontal = tanVertical * aspect;

  Fit across, along;
  for (const Eigen::Vector3d& p_map : points)
  {
    const Eigen::Vector3d p = axes.transpose() * p_map;
    across.add(p.x(), p.z(), tanHorizontal);
    along.add(p.y(), p.z(), tanVertical);
  }
  // The eye lies at `eyeHeight` on the axis towards it; the target may be anywhere below.
  const double eyeHeight = std::max(across.distance(tanHorizontal), along.distance(tanVertical));
  double meanHeight = 0;
  for (const Eigen::Vector3d& p_map : points) meanHeight += axes.col(2).dot(p_map);
  meanHeight /= static_cast<double>(points.size());

  constexpr double kNearest = 0.5;  // [m], for a single point
  camera.distance = std::max(eyeHeight - meanHeight, kNearest);
  camera.target = axes * Eigen::Vector3d(across.center(), along.center(), meanHeight);
  return camera;
}

}  // namespace quadmap
