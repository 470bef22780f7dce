#include "quadmap/estimation/Visibility.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "quadmap/geometry/Projection.h"

namespace quadmap
{
namespace
{
/** Share of the coarse depth cells with their centre inside the box in which the object cannot be
 * seen because something nearer is there or nothing was measured. It is 1 when there is no cell. */
double hiddenShare(
    const CoarseDepth& depth, const PinholeCamera& camera, const ImageBox& box, double nearestDepth)
{
  unsigned cells = 0, hidden = 0;
  for (unsigned row = 0; row < depth.rows; ++row)
    for (unsigned column = 0; column < depth.columns; ++column)
    {
      const double u = (column + 0.5) * camera.width / depth.columns;
      const double v = (row + 0.5) * camera.height / depth.rows;
      if (u < box.x1 || u > box.x2 || v < box.y1 || v > box.y2) continue;
      const double d = depth.depth[row * depth.columns + column];
      ++cells;
      hidden += d <= 0 || d < nearestDepth ? 1 : 0;
    }
  return cells == 0 ? 1.0 : static_cast<double>(hidden) / cells;
}

/** Does the way from a camera to a point lead into the cuboid and out of it again? */
bool leadsThrough(
    const Eigen::Vector3d& camera, const Eigen::Vector3d& point, const Ellipsoid& cuboid)
{
  const Eigen::Matrix3d R_obj_map = cuboid.rotation().transpose();
  const Eigen::Vector3d start = R_obj_map * (camera - cuboid.center());
  const Eigen::Vector3d way = R_obj_map * (point - camera);
  double in = 0, out = 1;  // shares of the way
  for (int axis = 0; axis < 3; ++axis)
  {
    const double half = cuboid.semiAxes()[axis];
    // Along an axis that the way does not move on, both are infinite.
    const auto [first, last] =
        std::minmax({(-half - start[axis]) / way[axis], (half - start[axis]) / way[axis]});
    in = std::max(in, first);
    out = std::min(out, last);
  }
  return in < out && out < 1;
}

/** The centre, and the points at 0.7 of the half axes: inside, where the outline is not at stake.
 */
std::array<Eigen::Vector3d, 7> pointsIn(const Ellipsoid& object)
{
  const Eigen::Matrix3d axes = 0.7 * object.rotation() * object.semiAxes().asDiagonal();
  const Eigen::Vector3d center = object.center();
  std::array<Eigen::Vector3d, 7> points;
  points[0] = center;
  for (int axis = 0; axis < 3; ++axis)
  {
    points[1 + 2 * axis] = center + axes.col(axis);
    points[2 + 2 * axis] = center - axes.col(axis);
  }
  return points;
}

}  // namespace

Ellipsoid FrameGeometry::toOptical(const Ellipsoid& object_map) const
{
  const mrpt::poses::CPose3D T_map_optical = T_map_sensor + T_sensor_optical();
  return object_map.transformed(-T_map_optical);
}

bool shouldBeVisible(
    const Ellipsoid& object,
    const FrameGeometry& frame,
    const ExistenceOptions& options,
    double minBoxSize)
{
  if (!frame.depth || frame.depth->empty()) return false;
  const Ellipsoid object_optical = frame.toOptical(object);
  const double range = object_optical.center().norm();
  if (range < options.minRange || range > options.maxRange) return false;

  const double nearestDepth = object_optical.cuboidCorners().row(2).minCoeff();
  if (nearestDepth <= 0.05) return false;  // reaches the camera plane
  const auto box = projectCuboidBox(frame.camera, object_optical);
  if (!box || !box->isValid()) return false;
  const ImageBox inside = box->clipped(frame.camera.width, frame.camera.height);
  if (inside.area() < options.visibleShare * box->area()) return false;
  if (std::min(inside.width(), inside.height()) < minBoxSize) return false;

  return hiddenShare(*frame.depth, frame.camera, inside, nearestDepth - options.occluderMargin) <=
         options.maxHiddenShare;
}

bool isBehind(
    const Ellipsoid& object,
    const std::vector<Ellipsoid>& things,
    const Eigen::Vector3d& camera,
    const ExistenceOptions& options)
{
  const auto points = pointsIn(object);
  const auto isHidden = [&](const Eigen::Vector3d& point)
  {
    return std::any_of(
        things.begin(), things.end(),
        [&](const Ellipsoid& thing) { return leadsThrough(camera, point, thing); });
  };
  const auto hidden = std::count_if(points.begin(), points.end(), isHidden);
  return static_cast<double>(hidden) > options.maxHiddenShare * points.size();
}

std::optional<ImageBox> projectedBox(
    const Ellipsoid& object, const FrameGeometry& frame, double shapeExponent)
{
  const Ellipsoid object_optical = frame.toOptical(object);
  if (shapeExponent > 1.5)
    if (auto box = projectEllipsoidBox(frame.camera, object_optical)) return box;
  return projectCuboidBox(frame.camera, object_optical);
}

}  // namespace quadmap
