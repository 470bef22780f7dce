#include <algorithm>
#include <cmath>
#include <limits>

#include "InsertionFrame.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/obs/PixelLabels.h"
#include "quadmap/perception/FramePerception.h"

namespace quadmap
{
namespace
{
/** A position this unlikely is not made up for by anything else; saves looking. */
constexpr double kHopeless = -60;

AssociationTarget targetOf(const MapObject& object)
{
  AssociationTarget t;
  t.observations = object.observations();
  t.labelCounts.assign(object.labelCounts.begin(), object.labelCounts.end());
  return t;
}

/** Largest deviation of a size from the label's typical one, in spreads; x and y are unordered. */
double sizeDeviation(const Ellipsoid& object, const LabelProperties& label)
{
  const auto ordered = [](Eigen::Vector3d size)
  {
    if (size.x() > size.y()) std::swap(size.x(), size.y());
    return size;
  };
  const Eigen::Array3d ratio =
      ordered(2 * object.semiAxes()).array() / ordered(label.typicalSize).array();
  return ratio.log().abs().maxCoeff() / label.sizeSpread;
}

/** Has perception not looked at it? It measures every box, and the depth of a frame without any. */
bool needsMeasuring(const CObservationObjects& obs)
{
  const bool noneMeasured = std::all_of(
      obs.objects.begin(), obs.objects.end(),
      [](const DetectedObject& d) { return d.measurement.kind == MeasurementKind::None; });
  return noneMeasured && (!obs.objects.empty() || obs.coarseDepth.empty());
}

}  // namespace

bool CQuadricObjectMap::internal_insertObservation(
    const mrpt::obs::CObservation& obs, const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
  const auto T_map_robot = robotPose.value_or(mrpt::poses::CPose3D());
  lastDecisions_.clear();
  std::optional<FramePairing::Frame> frame;
  if (const auto* boxes = dynamic_cast<const CObservationObjects*>(&obs); boxes)
  {
    if (!needsMeasuring(*boxes)) return insertObjects(*boxes, T_map_robot);
    frame = pairing_.add(*boxes, T_map_robot);
  }
  else if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&obs); scan)
  {
    frame = pairing_.add(*scan);
    const auto labelled =
        frame ? nullptr
              : boxesFromPixelLabels(
                    *scan, *labels_, perceptionOptions.minLabelPixels, unknownLabels_);
    if (labelled) frame = pairing_.add(*labelled, T_map_robot);
  }
  return frame && insertFrame(std::move(*frame));
}

bool CQuadricObjectMap::insertFrame(FramePairing::Frame frame)
{
  const mrpt::poses::CPose3D T_map_sensor = frame.robotPose + frame.boxes.sensorPose;
  const Eigen::Vector3d up_sensor = T_map_sensor.getRotationMatrix().asEigen().row(2);
  const auto surfaces =
      FramePerception(perceptionOptions, *labels_)
          .measure(*frame.scan, frame.boxes, up_sensor, room_.around(T_map_sensor));
  room_.add(surfaces, T_map_sensor);
  return insertObjects(frame.boxes, frame.robotPose);
}

bool CQuadricObjectMap::insertObjects(
    const CObservationObjects& obs, const mrpt::poses::CPose3D& robotPose)
{
  for (const auto& detected : obs.objects)
    if (!labels_->properties(detected.label).known) unknownLabels_.insert(detected.label);
  Frame frame = frameOf(obs, robotPose);
  associate(frame);
  std::set<ObjectId> touched;
  joinOrStart(frame, touched);
  countMisses(frame, touched);
  for (const ObjectId id : touched)
  {
    MapObject& object = require(id);
    if (isDue(object))
      estimate(object, false);
    else
      object.confirmed = isConfirmed(object);
  }
  mergeOverlapping(touched);
  return !touched.empty();
}

std::vector<CQuadricObjectMap::Decision> CQuadricObjectMap::match(
    const CObservationObjects& obs, const mrpt::poses::CPose3D& robotPose) const
{
  Frame frame = frameOf(obs, robotPose);
  associate(frame);
  return frame.decisions;
}

CQuadricObjectMap::Frame CQuadricObjectMap::frameOf(
    const CObservationObjects& obs, const mrpt::poses::CPose3D& robotPose) const
{
  Frame frame;
  frame.geometry = {pinholeFrom(obs.cameraParams), robotPose + obs.sensorPose, &obs.coarseDepth};
  frame.time = obs.timestamp;
  for (std::size_t k = 0; k < obs.objects.size(); ++k)
  {
    const DetectedObject& detected = obs.objects[k];
    const bool sure = detected.score >= insertionOptions.minScore;
    frame.allBoxes.push_back(detected.box);
    frame.allLabels.push_back(sure ? labels_->canonical(detected.label) : "");
    if (!sure) continue;
    if (hasBetterTwin(obs.objects, k, insertionOptions.agreement.duplicateIoU)) continue;
    auto view = viewOf(
        detected, frame.geometry.T_map_sensor,
        labels_->properties(labels_->canonical(detected.label)), insertionOptions.poseNoise);
    if (!view) continue;
    frame.boxes.push_back(k);
    frame.instances.push_back(detected.instanceId);
    frame.views.push_back(std::move(*view));
  }
  return frame;
}

void CQuadricObjectMap::associate(Frame& frame) const
{
  const auto& options = insertionOptions;
  std::vector<ObjectId> ids;
  std::vector<AssociationTarget> targets;
  for (const auto& [id, object] : objects_)
  {
    ids.push_back(id);
    targets.push_back(targetOf(object));
  }
  std::vector<AssociationCandidate> candidates;
  Eigen::MatrixXd likelihood(frame.views.size(), ids.size());
  for (std::size_t k = 0; k < frame.views.size(); ++k)
  {
    const ObjectView& view = frame.views[k];
    candidates.push_back({{}, {}, view.label, view.complete});
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      double& value = likelihood(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i));
      const MapObject& object = objects_.at(ids[i]);
      value = positionLogLikelihood(view, object, options.agreement);
      if (value > kHopeless)
        value += agreementLogLikelihood(
            view, frame.allBoxes[frame.boxes[k]], object, frame.geometry, *labels_,
            options.agreement);
      if (!options.useInstanceIds || !frame.instances[k]) continue;
      const auto known = objectOfInstance_.find(*frame.instances[k]);
      const bool isIt = known != objectOfInstance_.end() && known->second == ids[i];
      value = isIt ? 1e6 : -std::numeric_limits<double>::infinity();
    }
  }
  for (const auto& d : associateByLikelihood(candidates, targets, options.association, likelihood))
  {
    Decision decision;
    decision.box = frame.boxes[d.measurement];
    if (d.target) decision.object = ids[*d.target];
    decision.startedObject = d.startsObject;
    decision.logPosterior = d.logPosterior;
    decision.logPosteriorSecond = d.logPosteriorSecond;
    frame.decisions.push_back(decision);
  }
}

void CQuadricObjectMap::joinOrStart(const Frame& frame, std::set<ObjectId>& touched)
{
  lastDecisions_ = frame.decisions;
  for (std::size_t k = 0; k < frame.views.size(); ++k)
  {
    Decision& decision = lastDecisions_[k];
    const WaitingList::Entry entry{frame.views[k], frame.time};
    if (decision.object)
      addView(require(*decision.object), entry);
    else if (decision.startedObject)
      decision.object = startObject({entry});
    else if (const auto agreeing = waiting_.add(entry, *labels_, insertionOptions.waiting);
             !agreeing.empty())
    {
      decision.object = startObject(agreeing);
      decision.startedObject = true;
    }
    if (!decision.object) continue;
    touched.insert(*decision.object);
    if (frame.instances[k]) objectOfInstance_[*frame.instances[k]] = *decision.object;
  }
}

ObjectId CQuadricObjectMap::startObject(const std::vector<WaitingList::Entry>& entries)
{
  const ObjectId id = nextId_++;
  MapObject& object = objects_[id];
  object.id = id;
  object.firstSeen = entries.front().time;
  estimators_[id];
  std::deque<ObjectView> views;
  for (const auto& entry : entries) views.push_back(entry.view);
  object.object = ellipsoidOf(*medianState(views, labels_->properties(views.back().label)));
  for (const auto& entry : entries) addView(object, entry);
  return id;
}

void CQuadricObjectMap::addView(MapObject& object, const WaitingList::Entry& entry)
{
  const auto& existence = insertionOptions.existence;
  ++object.labelCounts[entry.view.label];
  ++(entry.view.complete ? object.completeCount : object.partialCount);
  object.lastSeen = entry.time;
  ObjectEstimator& estimator = estimators_.at(object.id);
  const double hit = std::log(existence.detectionProbability / existence.falseAlarmProbability);
  const double novelty =
      viewNovelty(entry.view.camera, entry.view.center, estimator.views(), existence);
  object.existenceLogOdds = std::min(existence.maxLogOdds, object.existenceLogOdds + novelty * hit);
  estimator.add(entry.view, insertionOptions.estimator);
}

void CQuadricObjectMap::countMisses(const Frame& frame, const std::set<ObjectId>& touched)
{
  const auto& existence = insertionOptions.existence;
  const double miss =
      std::log((1 - existence.detectionProbability) / (1 - existence.falseAlarmProbability));
  for (auto& [id, object] : objects_)
  {
    if (touched.count(id) != 0) continue;
    if (!shouldBeVisible(object.object, frame.geometry, existence)) continue;
    if (isShownByAFreeBox(object, frame)) continue;
    ++object.missCount;
    object.existenceLogOdds = std::max(-existence.maxLogOdds, object.existenceLogOdds + miss);
    object.confirmed = isConfirmed(object);
  }
}

bool CQuadricObjectMap::isShownByAFreeBox(const MapObject& object, const Frame& frame) const
{
  // Half of a box of the part that is seen lies in the object's outline, and is no speck in it.
  constexpr double kMinInside = 0.5, kMinIoU = 0.2;
  const auto& camera = frame.geometry.camera;
  auto outline = projectedBox(
      object.object, frame.geometry, labels_->properties(object.label()).shapeExponent);
  if (!outline) return false;
  *outline = outline->clipped(camera.width, camera.height);
  for (std::size_t k = 0; k < frame.allBoxes.size(); ++k)
  {
    const bool taken = std::any_of(
        lastDecisions_.begin(), lastDecisions_.end(),
        [&](const Decision& d) { return d.box == k && d.object; });
    if (taken || frame.allLabels[k].empty()) continue;
    const ImageBox& box = frame.allBoxes[k];
    const double iou = imageBoxIoU(box, *outline);
    const double shared = iou / (1 + iou) * (box.area() + outline->area());
    if (iou >= kMinIoU && shared >= kMinInside * box.area() &&
        labelAgreement(object, frame.allLabels[k], *labels_) >=
            insertionOptions.existence.minLabelShare)
      return true;
  }
  return false;
}

void CQuadricObjectMap::estimate(MapObject& object, bool restart)
{
  // Few measurements: where the optimiser starts still matters.
  constexpr unsigned kFewMeasurements = 10;
  const auto result = estimators_.at(object.id).estimate(
      uprightStateOf(object.object), labels_->properties(object.label()),
      insertionOptions.estimator, restart || object.observations() < kFewMeasurements);
  object.object = ellipsoidOf(result.state);
  object.covariance = result.covariance;
  object.orientationDefined = result.orientationDefined;
  object.confirmed = isConfirmed(object);
  estimatedFrom_[object.id] = object.observations();
}

bool CQuadricObjectMap::isDue(const MapObject& object) const
{
  const auto from = estimatedFrom_.find(object.id);
  return from == estimatedFrom_.end() ||
         object.observations() >= (1 + insertionOptions.estimateGrowth) * from->second;
}

bool CQuadricObjectMap::isConfirmed(const MapObject& object) const
{
  const auto& existence = insertionOptions.existence;
  const bool manyComplete = object.completeCount >= static_cast<unsigned>(existence.minComplete);
  const bool manyPartial = object.observations() >= static_cast<unsigned>(existence.minPartial) &&
                           sizeDeviation(object.object, labels_->properties(object.label())) <=
                               existence.maxSizeDeviation;
  const double centerSigma = std::sqrt(object.covariance.diagonal().head<3>().maxCoeff());
  const double sizeSigma = object.covariance.diagonal()
                               .tail<3>()
                               .cwiseSqrt()
                               .cwiseProduct(object.object.semiAxes())
                               .maxCoeff();
  return object.existenceLogOdds > existence.confirmLogOdds && (manyComplete || manyPartial) &&
         labelAgreement(object, object.label(), *labels_) >= existence.minLabelShare &&
         centerSigma < existence.maxCenterSigma && sizeSigma < existence.maxSizeSigma;
}

void CQuadricObjectMap::mergeOverlapping(std::set<ObjectId> touched)
{
  while (!touched.empty())
  {
    const ObjectId id = *touched.begin();
    touched.erase(touched.begin());
    const MapObject& object = objects_.at(id);
    const auto twin = std::find_if(
        objects_.begin(), objects_.end(),
        [&](const auto& other)
        {
          return other.first != id &&
                 areOneObject(object, other.second, *labels_, insertionOptions.merging);
        });
    if (twin == objects_.end()) continue;
    const bool keepsThis =
        object.observations() > twin->second.observations() ||
        (object.observations() == twin->second.observations() && id < twin->first);
    const ObjectId kept = keepsThis ? id : twin->first;
    const ObjectId absorbed = keepsThis ? twin->first : id;
    merge(kept, absorbed);
    touched.erase(absorbed);
    touched.insert(kept);  // it may have grown into another one
  }
}

void CQuadricObjectMap::consolidate()
{
  std::set<ObjectId> all;
  for (auto& [id, object] : objects_)
  {
    estimate(object, true);
    all.insert(id);
  }
  mergeOverlapping(all);
}

}  // namespace quadmap
