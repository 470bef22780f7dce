#include "quadmap/estimation/BoxMeasurement.h"

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/geometry/Whitening.h"

namespace quadmap
{
namespace
{
/** Standard deviation of where an outline is that may be anywhere between that of an ellipsoid and
 * that of its cuboid [m]. \param view Complete. \param n Of a plane that touches it, in the map. */
double outlineSigma(const ObjectView& view, const Eigen::Vector3d& n)
{
  const auto normals = view.faceNormals();
  const Eigen::Vector3d n_obj(n.dot(normals[0]), n.dot(normals[2]), n.dot(normals[4]));
  const Eigen::Vector3d& s = view.halfSizes;
  return (supportFunction(n_obj, s, 1.0) - supportFunction(n_obj, s, 2.0)) / std::sqrt(12.0);
}

/** The part of an edge's sigma by which all views of one side of a box err alike [m]. */
double edgeShapeSigma(
    const ObjectView& view, const ObjectView::Edge& edge, const EstimatorOptions& options)
{
  const double drawn = options.edgeShapeShare * view.halfSizes.mean();
  return view.complete ? std::hypot(drawn, outlineSigma(view, edge.plane.n)) : drawn;
}

/** The measurement with the map's axes turned by R and its origin moved.
 * \param origin Of the new frame, in the map [m]. */
BoxMeasurement measurementIn(
    const Eigen::Matrix3d& R_frame_map,
    const Eigen::Vector3d& origin,
    const ObjectView& view,
    const EstimatorOptions& options)
{
  BoxMeasurement m;
  static_cast<MeasuredGeometry&>(m) = view;
  m.camera = R_frame_map * (view.camera - origin);
  m.center = R_frame_map * (view.center - origin);
  m.hasSeed = !view.complete;
  if (m.hasSeed)
    m.seedWhitening =
        seedWhitening(R_frame_map * view.centerCovariance * R_frame_map.transpose(), options);
  if (view.complete && (!options.edgesOfComplete || view.allSidesKnown())) return m;
  m.edges.reserve(view.edges.size());
  for (const auto& edge : view.edges)
    m.edges.push_back(
        {R_frame_map * edge.plane.n, edgeSigma(view, edge, options),
         edgeShapeSigma(view, edge, options), boxSide(edge.plane.n, view.center - view.camera)});
  return m;
}

}  // namespace

BoxSide boxSide(const Eigen::Vector3d& inward, const Eigen::Vector3d& lineOfSight)
{
  using Eigen::Vector3d;
  const Vector3d across = lineOfSight.cross(Vector3d::UnitZ());
  const bool isVertical = across.norm() <= 1e-9 * lineOfSight.norm();
  const Vector3d right = isVertical ? Vector3d(Vector3d::UnitX()) : Vector3d(across.normalized());
  const double toRight = inward.dot(right);
  const double downward = inward.dot(lineOfSight.cross(right).normalized());
  if (std::abs(downward) > std::abs(toRight)) return downward > 0 ? BoxSide::Upper : BoxSide::Lower;
  return toRight > 0 ? BoxSide::Left : BoxSide::Right;
}

BoxMeasurement measurementFromRobot(
    const DetectedObject& detected,
    const ObjectView& view,
    const mrpt::poses::CPose3D& T_map_robot,
    const mrpt::poses::CPose3D& T_robot_sensor,
    const EstimatorOptions& options,
    double tiltSigma)
{
  const Eigen::Matrix3d R_robot_map = T_map_robot.getRotationMatrix().asEigen().transpose();
  BoxMeasurement m = measurementIn(R_robot_map, positionOf(T_map_robot), view, options);
  if (!view.complete) return m;
  const auto& measured = detected.measurement.complete->object_sensor;
  m.axes = T_robot_sensor.getRotationMatrix().asEigen() * measured.rotation();
  const bool onSupport = std::any_of(
      view.faces.begin(), view.faces.end(),
      [](const auto& face) { return face.kind == FaceKind::Support; });
  if (onSupport) m.tiltSigma = tiltSigma;
  return m;
}

BoxMeasurement measurementInMap(const ObjectView& view, const EstimatorOptions& options)
{
  BoxMeasurement m =
      measurementIn(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), view, options);
  const double cosine = std::cos(view.yaw), sine = std::sin(view.yaw);
  m.axes << cosine, -sine, 0, sine, cosine, 0, 0, 0, 1;
  return m;
}

double edgeSigma(
    const ObjectView& view, const ObjectView::Edge& edge, const EstimatorOptions& options)
{
  return std::hypot(
      (view.center - view.camera).norm() * edge.angle + view.pose.position + options.edgeFloor,
      edgeShapeSigma(view, edge, options));
}

Eigen::Matrix3d seedWhitening(const Eigen::Matrix3d& covariance, const EstimatorOptions& options)
{
  return std::sqrt(options.seedWeight) * whiteningOf(covariance);
}

}  // namespace quadmap
