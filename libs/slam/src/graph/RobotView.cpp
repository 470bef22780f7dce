#include "quadmap/slam/graph/RobotView.h"

#include <algorithm>

namespace quadmap
{
RobotView robotViewOf(
    const DetectedObject& detected,
    const ObjectView& view,
    const mrpt::poses::CPose3D& T_map_robot,
    const mrpt::poses::CPose3D& T_robot_sensor,
    const EstimatorOptions& options,
    double tiltSigma)
{
  const Eigen::Matrix3d R_robot_map = T_map_robot.getRotationMatrix().asEigen().transpose();
  const Eigen::Vector3d robot(T_map_robot.x(), T_map_robot.y(), T_map_robot.z());

  RobotView r;
  r.camera = R_robot_map * (view.camera - robot);
  r.center = R_robot_map * (view.center - robot);
  r.complete = view.complete;
  r.halfSizes = view.halfSizes;
  r.faces = view.faces;
  r.faceExponent = view.faceExponent;
  r.yawDefined = view.complete && view.yawDefined;
  r.yawSigma = view.yawSigma;
  if (view.complete)
  {
    const auto& measured = detected.measurement.complete->object_sensor;
    r.axes = T_robot_sensor.getRotationMatrix().asEigen() * measured.rotation();
    const bool onSupport = std::any_of(
        view.faces.begin(), view.faces.end(),
        [](const auto& face) { return face.kind == FaceKind::Support; });
    if (onSupport) r.tiltSigma = tiltSigma;
  }
  else
  {
    r.hasSeed = true;
    r.seedWhitening =
        seedWhitening(R_robot_map * view.centerCovariance * R_robot_map.transpose(), options);
  }
  if (view.complete && (!options.edgesOfComplete || view.allSidesKnown())) return r;
  for (const auto& edge : view.edges)
    r.edges.push_back({R_robot_map * edge.plane.n, edgeSigma(view, edge, options)});
  return r;
}

}  // namespace quadmap
