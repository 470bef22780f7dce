#include <algorithm>
#include <cmath>

#include "InsertionFrame.h"
#include "quadmap/estimation/ResidualRow.h"
#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/obs/FrameAgreement.h"
#include "quadmap/perception/BoxEdges.h"
#include "quadmap/perception/RoomPerception.h"

// The likelihood of an observation: section 14 of doc/mathematics.md.
namespace quadmap
{
namespace
{
/** -1/2 chi^2 of a complete measurement, (14.2): centre, and yaw where both have one. */
double completeTerm(
    const ObjectView& view, const MapObject& object, const LikelihoodOptions& options)
{
  const double sigma2 = options.positionSigma * options.positionSigma;
  const Eigen::Matrix3d S = view.centerCovariance + object.covariance.topLeftCorner<3, 3>() +
                            sigma2 * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d off = view.center - object.object.center();
  double chi2 = off.dot(S.llt().solve(off));
  if (view.yawDefined && object.orientationDefined)
  {
    const double yaw = yawDistance(view.yaw, uprightStateOf(object.object)[3]);
    chi2 += yaw * yaw /
            (view.yawSigma * view.yawSigma + object.covariance(3, 3) +
             options.yawSigma * options.yawSigma);
  }
  return -0.5 * chi2;
}

/** -1/2 chi^2 of a partial measurement, (14.3): its box edges should touch the object in front of
 * the camera, and its seed should lie in it. Without depth there is no term of the seed. */
double edgesTerm(
    const ObjectView& view,
    bool hasSeed,
    const MapObject& object,
    double shapeExponent,
    const LikelihoodOptions& options)
{
  double chi2 = 0;
  const Eigen::Vector3d toObject = object.object.center() - view.camera;
  for (const auto& edge : view.edges)
  {
    const double sigma =
        toObject.norm() * std::hypot(edge.angle, options.angleSigma) + view.positionSigma;
    const double gap = tangencyResidual(edge.plane, object.object, shapeExponent);
    chi2 += gap * gap / (sigma * sigma);
  }
  if (!hasSeed) return -0.5 * chi2;
  const Eigen::Vector3d off = view.center - object.object.center();
  const double sigma2 = options.positionSigma * options.positionSigma;
  const Eigen::Matrix3d S = view.centerCovariance + sigma2 * Eigen::Matrix3d::Identity();
  return -0.5 * (chi2 + off.dot(S.llt().solve(off)));
}

/** What the edges of a box alone say, also of a box too few of whose edges are usable for a place.
 * Nothing when no edge is usable. Edges beside a hidden lower end count here, other than in the
 * estimate of an object: they would spoil its width, but a known object and one of them tell where
 * the camera looks. */
std::optional<ObjectView> edgeView(
    const DetectedObject& detected,
    const mrpt::poses::CPose3D& T_map_sensor,
    const std::string& label,
    const PoseNoise& noise)
{
  if (detected.measurement.kind != MeasurementKind::Partial) return {};
  ObjectView view;
  view.label = label;
  view.camera = positionOf(T_map_sensor);
  view.positionSigma = noise.position;
  view.edges = usableEdges(detected.measurement, T_map_sensor, noise);
  if (view.edges.empty()) return {};
  return view;
}

bool isInFront(const Eigen::Vector3d& p_map, const mrpt::poses::CPose3D& T_map_sensor)
{
  return T_map_sensor.inverseComposePoint(mrpt::math::TPoint3D(p_map.x(), p_map.y(), p_map.z())).x >
         0;
}

bool isUnmeasured(const DetectedObject& detected)
{
  return detected.measurement.kind == MeasurementKind::None;
}

bool saysSomething(const DetectedObject& detected)
{
  return detected.measurement.kind == MeasurementKind::Complete ||
         detected.measurement.kind == MeasurementKind::Partial;
}

/** Gives the unmeasured boxes the measurements of the same boxes in another observation. */
void fillIn(const CObservationObjects& measured, CObservationObjects& boxes)
{
  for (std::size_t k = 0; k < boxes.objects.size(); ++k)
    if (isUnmeasured(boxes.objects[k]))
      boxes.objects[k].measurement = measured.objects[k].measurement;
}

}  // namespace

bool CQuadricObjectMap::internal_canComputeObservationLikelihood(
    const mrpt::obs::CObservation& obs) const
try
{
  const auto* given = dynamic_cast<const CObservationObjects*>(&obs);
  if (!given) return false;
  if (given->objects.empty()) return false;
  requireCalibration(given->cameraParams, "the camera of the boxes");
  CObservationObjects boxes = *given;
  const auto isUnsure = [this](const DetectedObject& detected)
  { return detected.score < insertionOptions.minScore; };
  boxes.objects.erase(
      std::remove_if(boxes.objects.begin(), boxes.objects.end(), isUnsure), boxes.objects.end());
  if (std::any_of(boxes.objects.begin(), boxes.objects.end(), saysSomething)) return true;
  // Depth can say something of a box of which every edge is cut.
  if (std::any_of(boxes.objects.begin(), boxes.objects.end(), isUnmeasured) &&
      pairing_.scanOf(boxes))
    return true;
  CObservationObjects filled = boxes, byEdges = boxes;
  measureWithoutDepth(byEdges, perceptionOptions);
  fillIn(byEdges, filled);
  return std::any_of(filled.objects.begin(), filled.objects.end(), saysSomething);
}
catch (const std::runtime_error&)  // no usable calibration
{
  return false;
}

CObservationObjects CQuadricObjectMap::measured(
    const CObservationObjects& boxes, const mrpt::poses::CPose3D& T_map_robot) const
{
  CObservationObjects filled = boxes, all = boxes;
  if (const auto scan = pairing_.scanOf(boxes))
    measureInRoom(
        FramePerception(perceptionOptions, labels()), *scan, all, T_map_robot + boxes.sensorPose,
        room_);
  else
    measureWithoutDepth(all, perceptionOptions);
  fillIn(all, filled);
  return filled;
}

double CQuadricObjectMap::viewLikelihood(
    const ObjectView& view, bool hasSeed, const mrpt::poses::CPose3D& T_map_sensor) const
{
  double explained = 0;
  for (const auto& [id, object] : objects_)
  {
    if (likelihoodOptions.onlyConfirmed && !object.confirmed) continue;
    const double agreement = labelAgreement(object, view.label, labels());
    if (agreement == 0) continue;
    if (!view.complete && !hasSeed && !isInFront(object.object.center(), T_map_sensor)) continue;
    const double term =
        view.complete ? completeTerm(view, object, likelihoodOptions)
                      : edgesTerm(
                            view, hasSeed, object,
                            labels().properties(object.label()).shapeExponent, likelihoodOptions);
    explained += agreement * std::exp(term);
  }
  const double outliers = likelihoodOptions.outlierShare;
  return std::log(outliers + (1 - outliers) * std::min(explained, 1.0));
}

/** The sum (14.1) over the boxes that say something. */
double CQuadricObjectMap::internal_computeObservationLikelihood(
    const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& takenFrom) const
{
  const auto* given = dynamic_cast<const CObservationObjects*>(&obs);
  if (!given) return 0;
  const bool isWhole = std::none_of(given->objects.begin(), given->objects.end(), isUnmeasured);
  const CObservationObjects filled = isWhole ? CObservationObjects() : measured(*given, takenFrom);
  const CObservationObjects& boxes = isWhole ? *given : filled;

  const Frame frame = frameOf(boxes, UncertainPose(takenFrom, {0, 0}));
  const auto& T_map_sensor = frame.geometry.T_map_sensor;
  double logLikelihood = 0;
  for (std::size_t i = 0; i < frame.views.size(); ++i)
  {
    const bool hasSeed = boxes.objects[frame.boxes[i]].measurement.seed_sensor.has_value();
    logLikelihood += viewLikelihood(frame.views[i], hasSeed, T_map_sensor);
  }
  for (const std::size_t k : frame.boxesWithoutPlace)
    if (const auto view = edgeView(
            boxes.objects[k], T_map_sensor, frame.allLabels[k], insertionOptions.poseNoise))
      logLikelihood += viewLikelihood(*view, false, T_map_sensor);
  return logLikelihood;
}

}  // namespace quadmap
