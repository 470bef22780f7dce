#include "quadmap/quadric/BoxView.h"

#include <algorithm>
#include <cmath>

#include "quadmap/estimation/ObjectRules.h"
#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
/** Factor on the outline's sigma, doc/mathematics.md, (17.2). Neighbouring views share what the
 * outline has over an ellipsoid's: four of them know as much as one that erred independently. */
constexpr double kSharedOutline = 2;

/** Width and height of the image as angles, their geometric mean [rad]. */
double fieldOfViewOf(const PinholeCamera& camera)
{
  const auto angle = [](double size, double f) { return 2 * std::atan(0.5 * size / std::abs(f)); };
  return std::sqrt(angle(camera.width, camera.fx) * angle(camera.height, camera.fy));
}

}  // namespace

std::size_t BoxView::usableEdges() const
{
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [](const Edge& e) { return e.usable; }));
}

PlacedBox BoxView::placedAt(const CPose3D& T_map_robot) const
{
  const Eigen::Matrix3d R = T_map_robot.getRotationMatrix().asEigen();
  PlacedBox placed;
  placed.camera = positionOf(T_map_robot) + R * camera;
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    placed.edges[e] = Plane::throughPoint(R * edges[e].normal, placed.camera);
    placed.usable[e] = edges[e].usable;
  }
  return placed;
}

BoxMeasurement BoxView::measurementFor(
    const CPose3D& T_map_robot,
    const Ellipsoid& object,
    const PoseNoise& noise,
    const EstimatorOptions& options) const
{
  const double range = (object.center() - placedAt(T_map_robot).camera).norm();
  const double outline = kSharedOutline * kOutlineSpread * object.semiAxes().mean();
  BoxMeasurement view;
  view.camera = camera;
  for (const Edge& edge : edges)
  {
    const double sigma =
        range * std::hypot(edge.angleSigma, noise.angle) + noise.position + options.edgeFloor;
    if (edge.usable) view.edges.push_back({edge.normal, std::hypot(sigma, outline)});
  }
  return view;
}

std::vector<BoxView> boxViewsOf(
    const CObservationObjects& boxes,
    std::size_t keyframe,
    const LabelTable& labels,
    const InsertionOptions& options)
{
  const Eigen::Matrix3d R = boxes.sensorPose.getRotationMatrix().asEigen();
  const auto stays = surestOfTwins(boxes.objects, labels, options.agreement);
  std::vector<BoxView> views;
  for (std::size_t k = 0; k < boxes.objects.size(); ++k)
  {
    const DetectedObject& detected = boxes.objects[k];
    if (!detected.measurement.edges || detected.score < options.minScore || !stays[k]) continue;
    BoxView view;
    view.keyframe = keyframe;
    view.box = k;
    view.label = labels.canonical(detected.label);
    view.instance = detected.instanceId;
    view.camera = positionOf(boxes.sensorPose);
    view.fieldOfView = fieldOfViewOf(pinholeFrom(boxes.cameraParams));
    for (std::size_t e = 0; e < view.edges.size(); ++e)
    {
      const EdgeMeasurement& edge = (*detected.measurement.edges)[e];
      view.edges[e] = {R * edge.plane_sensor.n, edge.sigmaAngle, edge.state == EdgeState::Usable};
    }
    if (view.usableEdges() > 0) views.push_back(std::move(view));
  }
  return views;
}

}  // namespace quadmap
