#include <limits>

#include "InsertionFrame.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/obs/FrameAgreement.h"

// Which object a box shows: section 12 of doc/mathematics.md. The terms (12.3) to (12.11) and the
// decision are in quadmap/estimation/Association.h.
namespace quadmap
{
namespace
{
/** Nothing makes up for a position less likely than this, so the other terms are not computed. */
constexpr double kHopeless = -60;
/** Log-likelihood of the object whose instance id the box has, when ids are believed. */
constexpr double kCertain = 1e6;

AssociationTarget targetOf(const MapObject& object)
{
  AssociationTarget t;
  t.observations = object.observations();
  t.labelCounts.assign(object.labelCounts.begin(), object.labelCounts.end());
  return t;
}

}  // namespace

std::vector<CQuadricObjectMap::Decision> CQuadricObjectMap::match(
    const CObservationObjects& obs, const UncertainPose& robotPose) const
{
  Frame frame = frameOf(obs, robotPose);
  associate(frame);
  return frame.decisions;
}

std::vector<CQuadricObjectMap::Decision> CQuadricObjectMap::match(
    const CObservationObjects& obs, const mrpt::poses::CPose3D& robotPose) const
{
  return match(obs, UncertainPose(robotPose, {0, 0}));
}

CQuadricObjectMap::Frame CQuadricObjectMap::frameOf(
    const CObservationObjects& obs, const UncertainPose& robotPose) const
{
  if (!obs.objects.empty())
    requireCalibration(obs.cameraParams, "the camera of the boxes of \"" + obs.sensorLabel + "\"");
  const LabelTable& table = labels();
  const PoseNoise noise = combined(insertionOptions.poseNoise, robotPose.error);
  Frame frame;
  frame.geometry = {
      pinholeFrom(obs.cameraParams), robotPose.mean + obs.sensorPose, &obs.coarseDepth};
  frame.time = obs.timestamp;
  const auto stays = surestOfTwins(obs.objects, table, insertionOptions.agreement);
  for (std::size_t k = 0; k < obs.objects.size(); ++k)
  {
    const DetectedObject& detected = obs.objects[k];
    const bool sure = detected.score >= insertionOptions.minScore;
    frame.allBoxes.push_back(detected.box);
    frame.allLabels.push_back(sure ? table.canonical(detected.label) : "");
    if (!sure || !stays[k]) continue;
    auto view = viewOf(
        detected, frame.geometry.T_map_sensor, table.properties(table.canonical(detected.label)),
        noise);
    if (!view)
    {
      frame.boxesWithoutPlace.push_back(k);
      continue;
    }
    frame.boxes.push_back(k);
    frame.instances.push_back(detected.instanceId);
    frame.views.push_back(std::move(*view));
  }
  return frame;
}

/** The last terms of (12.1): ln p(z | object), (12.3) to (12.6) and (12.11), and the agreement,
 * (12.7) to (12.9).
 */
double CQuadricObjectMap::associationLikelihood(
    const Frame& frame, std::size_t k, const MapObject& object) const
{
  const auto& options = insertionOptions;
  if (options.useInstanceIds && frame.instances[k])
  {
    const auto known = objectOfInstance_.find(*frame.instances[k]);
    const bool isIt = known != objectOfInstance_.end() && known->second == object.id;
    return isIt ? kCertain : -std::numeric_limits<double>::infinity();
  }
  const ObjectView& view = frame.views[k];
  const double position = positionLogLikelihood(view, object, options.agreement);
  if (!(position > kHopeless)) return position;
  return position + agreementLogLikelihood(
                        view, frame.allBoxes[frame.boxes[k]], object, frame.geometry, labels(),
                        options.agreement);
}

void CQuadricObjectMap::associate(Frame& frame) const
{
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
    candidates.push_back({frame.views[k].label, frame.views[k].complete});
    for (std::size_t i = 0; i < ids.size(); ++i)
      likelihood(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
          associationLikelihood(frame, k, objects_.at(ids[i]));
  }
  for (const auto& d :
       associateFrame(candidates, targets, insertionOptions.association, likelihood))
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

}  // namespace quadmap
