#include "JointBackEnd.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "GraphOptions.h"
#include "MergedObjects.h"
#include "PoseMarginals.h"
#include "quadmap/estimation/ObjectRules.h"
#include "quadmap/estimation/RepeatedErrors.h"
#include "quadmap/estimation/ViewRedundancy.h"
#include "quadmap/estimation/ViewResiduals.h"
#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** Standard deviations of a pose from the covariance of its steps (turn, move). */
PoseNoise noiseOf(const Eigen::Matrix<double, 6, 6>& covariance)
{
  PoseNoise noise;
  noise.angle = std::sqrt(covariance.diagonal().head<3>().mean());
  noise.position = std::sqrt(covariance.diagonal().tail<3>().mean());
  return noise;
}

/** A step from a pose to where it is if only what it takes for up is wrong.
 * \param sigma Of turns about the map's x and y axes [rad]. */
CPose3DPDFGaussian tiltOf(const CPose3D& pose, double sigma)
{
  constexpr double kFixed = 1e-4;  // [m], [rad]
  const Eigen::Matrix3d R = pose.getRotationMatrix().asEigen();
  const Eigen::Vector3d variances(sigma * sigma, sigma * sigma, kFixed * kFixed);
  const Eigen::Matrix3d turns = R.transpose() * variances.asDiagonal() * R;
  CPose3DPDFGaussian step;
  for (int r = 0; r < 3; ++r)
  {
    step.cov(r, r) = kFixed * kFixed;
    // Of small angles yaw, pitch and roll are turns about z, y and x.
    for (int c = 0; c < 3; ++c) step.cov(3 + r, 3 + c) = turns(2 - r, 2 - c);
  }
  return step;
}

}  // namespace

JointBackEnd::JointBackEnd(
    const JointOptions& options,
    const CQuadricObjectMap::TInsertionOptions& mapOptions,
    const LabelTable& labels,
    const ConstellationOptions& places) :
    options_(options),
    viewNoise_(mapOptions.poseNoise),
    estimator_(mapOptions.estimator),
    existence_(mapOptions.existence),
    agreement_(mapOptions.agreement),
    labels_(labels),
    places_(places),
    graph_(graphOptions(options, mapOptions.estimator, GraphScope::Window))
{
}

std::optional<BoxMeasurement> JointBackEnd::viewFor(
    const CObservationObjects& boxes,
    std::size_t box,
    const CPose3D& T_map_robot,
    const MapObject& object) const
{
  const DetectedObject& detected = boxes.objects.at(box);
  auto view = viewOf(
      detected, T_map_robot + boxes.sensorPose,
      labels_.properties(labels_.canonical(detected.label)), viewNoise_);
  if (view) view = measurementOf(object, std::move(*view), labels_, agreement_);
  if (!view) return std::nullopt;
  if (object.isRound) view->faceExponent = kCircle;
  BoxMeasurement r = measurementFromRobot(
      detected, *view, T_map_robot, boxes.sensorPose, estimator_, options_.tiltSigma);
  r.weight = viewWeight(*view, uprightStateOf(object.object));
  return r;
}

void JointBackEnd::addViews(
    const CObservationObjects& boxes,
    const Decisions& decisions,
    std::size_t pose,
    const CQuadricObjectMap& map)
{
  const CPose3D T_map_robot = graph_.pose(pose);
  const Eigen::Vector3d camera = positionOf(T_map_robot + boxes.sensorPose);
  for (const auto& decision : decisions)
  {
    const MapObject* object = decision.object ? map.find(*decision.object) : nullptr;
    if (!object) continue;
    auto view = viewFor(boxes, decision.box, T_map_robot, *object);
    if (!view) continue;
    if (!graph_.hasObject(object->id))
      graph_.setObject(object->id, object->object, propertiesOf(*object, labels_));
    view->weight *=
        independentShare(camera, object->object.center(), cameras_[object->id], existence_);
    graph_.addView(pose, object->id, *view);
  }
}

CPose3D JointBackEnd::addKeyframe(
    const CPose3D& T_odom_robot,
    const std::optional<CPose3DPDFGaussian>& step,
    const CObservationObjects* boxes,
    SlamResult& result)
{
  const auto motion = odometry_.next(T_odom_robot);
  const CPose3D predicted = motion ? graph_.pose(graph_.poses() - 1) + *motion : T_odom_robot;
  const std::size_t pose = graph_.addPose(predicted);
  if (pose > 0 && step) graph_.addStep(pose - 1, pose, stiffAtRest(*step));
  if (!boxes) return predicted;

  CQuadricObjectMap& map = result.map;
  const auto window = static_cast<std::size_t>(options_.window);
  const std::size_t firstFree = pose < window ? 1 : pose + 1 - window;
  const auto before = graph_.marginals(firstFree, false);
  addViews(
      *boxes, map.match(*boxes, UncertainPose(predicted, noiseOf(before.lastPose))), pose, map);
  graph_.optimiseWindow(firstFree);
  // The step that is about to leave the window is known best: it is judged then, once.
  const bool isFull = graph_.poses() > window;
  const auto fit = graph_.windowFit(firstFree, {firstFree + 1, firstFree + (isFull ? 2 : 1)});
  stepFit_ += fit.steps;
  // What is taken for certain too early makes wrong associations.
  graph_.setStepNoise(stepNoiseOf(stepFit_, options_.claimWeight).atLeastClaimed());

  insertIntoMap(*boxes, pose, graph_.pose(pose), result, noiseOf(fit.lastPose));
  followMerged(map, graph_, cameras_);
  graph_.removeViews(pose);
  addViews(*boxes, map.lastDecisions(), pose, map);
  const Eigen::Vector3d camera = positionOf(graph_.pose(pose) + boxes->sensorPose);
  for (const auto& decision : map.lastDecisions())
    if (decision.object) rememberCamera(camera, cameras_[*decision.object]);
  return graph_.pose(pose);
}

/** What the boxes show of one object, visit by visit. */
struct JointBackEnd::Visit
{
  std::vector<std::size_t> keyframes;
  std::vector<Eigen::Vector3d> cameras;  // positions in the map [m]
  std::vector<BoxMeasurement> views;
};

JointBackEnd::Visits JointBackEnd::visitsOf(
    const BoxesOf& boxesOf, const SlamResult& result, Returns returns) const
{
  const auto window = static_cast<std::size_t>(options_.window);
  Visits all;
  for (std::size_t k = 0; k < result.keyframes.size(); ++k)
  {
    const CPose3D& T_map_robot = result.keyframes[k].T_map_robot;
    const auto boxes = boxesOf(k);
    if (!boxes) continue;
    for (const auto& decision : result.map.match(*boxes, T_map_robot))
    {
      const MapObject* object = decision.object ? result.map.find(*decision.object) : nullptr;
      if (!object) continue;
      auto view = viewFor(*boxes, decision.box, T_map_robot, *object);
      if (!view) continue;
      auto& ofOne = all[object->id];
      if (ofOne.empty() ||
          (returns == Returns::FindOtherObjects && ofOne.back().keyframes.back() + window < k))
        ofOne.emplace_back();
      Visit& visit = ofOne.back();
      visit.keyframes.push_back(k);
      visit.cameras.push_back(positionOf(T_map_robot + boxes->sensorPose));
      visit.views.push_back(std::move(*view));
    }
  }
  return all;
}

void JointBackEnd::addVisits(
    Visits all,
    const CQuadricObjectMap& map,
    const Priors& priors,
    std::size_t firstPose,
    FactorGraph& graph) const
{
  ObjectId other = all.empty() ? 0 : all.rbegin()->first + 1;
  for (auto& [id, visits] : all)
    for (Visit& visit : visits)
    {
      const MapObject& object = *map.find(id);
      const ObjectId inGraph = &visit == &visits.front() ? id : other++;
      graph.setObject(inGraph, object.object, propertiesOf(object, labels_));
      if (const auto prior = priors.find(id); prior != priors.end())
        graph.setObjectPrior(inGraph, prior->second);
      const auto shares = independentShares(visit.cameras, object.object.center(), existence_);
      for (std::size_t i = 0; i < shares.size(); ++i) visit.views[i].weight *= shares[i];
      shareEdgeErrors(visit.views);
      for (std::size_t i = 0; i < shares.size(); ++i)
        graph.addView(firstPose + visit.keyframes[i], inGraph, visit.views[i]);
    }
}

FactorGraph JointBackEnd::globalGraph(
    const BoxesOf& boxesOf,
    const SlamResult& result,
    const Priors& priors,
    FirstPose firstPose,
    Returns returns) const
{
  if (returns == Returns::FindOtherObjects && !priors.empty())
    throw std::invalid_argument("JointBackEnd: priors of objects that are others at each visit");
  FactorGraph graph(graphOptions(options_, estimator_, GraphScope::WholeRun));
  const bool mayTilt = priors.empty() && firstPose == FirstPose::FreeToTilt &&
                       options_.upSigma > 0 && result.odometry.source == PoseSource::Visual &&
                       !result.keyframes.empty();
  if (!priors.empty()) graph.addPose(CPose3D());
  if (mayTilt) graph.addPose(result.keyframes.front().T_map_robot);
  const std::size_t first = graph.poses();
  for (const Keyframe& keyframe : result.keyframes)
  {
    const std::size_t pose = graph.addPose(keyframe.T_map_robot);
    if (pose == first && mayTilt)
      graph.addKnownStep(0, pose, tiltOf(keyframe.T_map_robot, options_.upSigma));
    if (pose > first && keyframe.odometryStep)
      graph.addStep(pose - 1, pose, stiffAtRest(*keyframe.odometryStep));
  }
  addVisits(visitsOf(boxesOf, result, returns), result.map, priors, first, graph);
  return graph;
}

double JointBackEnd::takePoses(const FactorGraph& graph, const Priors& priors, SlamResult& result)
{
  const std::size_t first = graph.poses() - result.keyframes.size();
  const auto poseOf = [&](std::size_t k) { return graph.pose(first + k); };
  const CPose3D T_map_graph =
      priors.empty() ? alignmentWithOdometry(poseOf, result.keyframes) : CPose3D();
  return movePoses(T_map_graph, poseOf, result.keyframes);
}

void JointBackEnd::estimate(
    const KnownObjects& knownObjects, const BoxesOf& boxesOf, SlamResult& result) const
{
  CorrectionSummary summary;
  summary.stepNoise = stepNoiseOf(stepFit_, options_.claimWeight);
  for (; summary.rounds < options_.rounds && !summary.converged; ++summary.rounds)
  {
    const Priors priors = knownObjects(result.map);
    FactorGraph graph = globalGraph(boxesOf, result, priors, FirstPose::FreeToTilt);
    graph.setStepNoise(summary.stepNoise);
    graph.optimise();
    summary.stepNoise = stepNoiseOf(graph.stepFit(), options_.claimWeight);
    summary.lastMove = takePoses(graph, priors, result);
    rebuildMap(boxesOf, result);
    summary.converged = summary.lastMove < options_.smallMove;
  }
  result.correction = summary;
  const Priors priors = knownObjects(result.map);
  // With the objects of the final map, and covariances relative to the first pose.
  FactorGraph graph = globalGraph(boxesOf, result, priors, FirstPose::Fixed);
  graph.setStepNoise(summary.stepNoise);
  result.edges = graph.graphEdges();
  for (auto& edge : result.edges) edge.pose -= graph.poses() - result.keyframes.size();
  noteMarginals(graph, result.keyframes);
  const std::size_t first = graph.poses() - result.keyframes.size();
  const auto marginals = graph.alignedObjectMarginals(first);
  if (marginals.empty()) return;
  const auto atThesePoses = graph.objectMarginals();
  for (const auto& [id, marginal] : marginals)
    result.map.setSharedError(id, withoutNegative(marginal - atThesePoses.at(id)));
}

void JointBackEnd::finish(const BoxesOf& boxesOf, SlamResult& result)
{
  for (std::size_t k = 0; k < result.keyframes.size(); ++k)
    result.keyframes[k].T_map_robot = graph_.pose(k);
  consolidateMap(result);
  estimate([](const CQuadricObjectMap&) { return Priors(); }, boxesOf, result);
}

void JointBackEnd::correctWith(
    const KnownObjects& knownObjects, const BoxesOf& boxesOf, SlamResult& result)
{
  rebuildMap(boxesOf, result);
  estimate(knownObjects, boxesOf, result);
}

}  // namespace quadmap
