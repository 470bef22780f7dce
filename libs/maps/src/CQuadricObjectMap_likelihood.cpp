#include <algorithm>

#include "InsertionFrame.h"
#include "quadmap/geometry/PosePosition.h"
#include "quadmap/maps/FrameLikelihood.h"
#include "quadmap/obs/FrameAgreement.h"
#include "quadmap/perception/BoxEdges.h"
#include "quadmap/perception/RoomPerception.h"

// Which boxes and objects the likelihood of an observation compares: section 14 of
// doc/mathematics.md.
namespace quadmap
{
namespace
{
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
  view.pose = noise;
  view.edges = usableEdges(detected.measurement, T_map_sensor, noise);
  if (view.edges.empty()) return {};
  return view;
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

/** The objects that boxes are compared with. Pointers to the same ones go into `objects`. */
std::vector<FrameLikelihood::Target> CQuadricObjectMap::targets(
    std::vector<const MapObject*>& objects) const
{
  std::vector<FrameLikelihood::Target> found;
  for (const auto& [id, object] : objects_)
  {
    if (likelihoodOptions.onlyConfirmed && !object.confirmed) continue;
    objects.push_back(&object);
    found.push_back(
        {object.object, object.covariance.topLeftCorner<3, 3>(), uprightStateOf(object.object)[3],
         object.covariance(3, 3), object.orientationDefined,
         labels().properties(object.label()).shapeExponent});
  }
  return found;
}

FrameLikelihood CQuadricObjectMap::likelihoodOf(
    const CObservationObjects& boxes, const mrpt::poses::CPose3D& attitude) const
{
  const mrpt::poses::CPose3D T_level_robot(0, 0, 0, 0, attitude.pitch(), attitude.roll());
  const Frame frame = frameOf(boxes, UncertainPose(T_level_robot, {0, 0}));
  const auto& T_level_sensor = frame.geometry.T_map_sensor;
  const Eigen::Vector3d forward = T_level_sensor.getRotationMatrix().asEigen().col(0);
  std::vector<FrameLikelihood::Box> seen;
  for (std::size_t i = 0; i < frame.views.size(); ++i)
  {
    const bool hasSeed = boxes.objects[frame.boxes[i]].measurement.seed_sensor.has_value();
    seen.push_back({frame.views[i], hasSeed, true, forward});
  }
  for (const std::size_t k : frame.boxesWithoutPlace)
    if (const auto view = edgeView(
            boxes.objects[k], T_level_sensor, frame.allLabels[k], insertionOptions.poseNoise))
      seen.push_back({*view, false, false, forward});

  std::vector<const MapObject*> objects;
  auto known = targets(objects);
  std::vector<FrameLikelihood::Pairing> pairings;
  for (std::size_t k = 0; k < seen.size(); ++k)
    for (std::size_t i = 0; i < objects.size(); ++i)
      if (const double agreement = labelAgreement(*objects[i], seen[k].view.label, labels());
          agreement > 0)
        pairings.push_back({k, i, agreement});
  return {std::move(seen), std::move(known), std::move(pairings), likelihoodOptions};
}

double CQuadricObjectMap::internal_computeObservationLikelihood(
    const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& takenFrom) const
{
  const auto* given = dynamic_cast<const CObservationObjects*>(&obs);
  if (!given) return 0;
  const bool isWhole = std::none_of(given->objects.begin(), given->objects.end(), isUnmeasured);
  const CObservationObjects filled = isWhole ? CObservationObjects() : measured(*given, takenFrom);
  return likelihoodOf(isWhole ? *given : filled, takenFrom)
      .at({positionOf(takenFrom), takenFrom.yaw()});
}

}  // namespace quadmap
