#include "QuadricBackEnd.h"

#include <algorithm>

#include "GraphOptions.h"
#include "PoseMarginals.h"
#include "quadmap/estimation/ViewRedundancy.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace
{
FactorGraphOptions graphWithoutFloor(
    JointOptions options, const EstimatorOptions& estimator, GraphScope scope)
{
  options.floorSigma = 0;  // whatever an ellipsoid that touches boxes stands on, it is no floor
  return graphOptions(options, estimator, scope);
}

bool isSame(const std::vector<BoxDecision>& a, const std::vector<BoxDecision>& b)
{
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const BoxDecision& x, const BoxDecision& y)
      {
        return x.keyframe == y.keyframe && x.decision.box == y.decision.box &&
               x.decision.object == y.decision.object;
      });
}

/** Boxes of an object that was absorbed show the one that was kept. */
void follow(
    const std::vector<std::pair<ObjectId, ObjectId>>& merged, std::vector<BoxDecision>& decisions)
{
  for (const auto& [kept, absorbed] : merged)
    for (auto& [keyframe, decision] : decisions)
      if (decision.object == absorbed) decision.object = kept;
}

}  // namespace

QuadricBackEnd::QuadricBackEnd(
    const JointOptions& options,
    const CQuadricObjectMap::TInsertionOptions& mapOptions,
    bool correctPoses,
    const LabelTable& labels) :
    options_(options),
    mapOptions_(mapOptions),
    correctPoses_(correctPoses),
    labels_(labels),
    graph_(graphWithoutFloor(options, mapOptions.estimator, GraphScope::Window)),
    objects_(mapOptions, labels)
{
}

QuadricBackEnd::Decisions QuadricBackEnd::associate(
    const CObservationObjects& boxes,
    std::size_t keyframe,
    const Matrix6& poseCovariance,
    const QuadricObjects::PoseOf& poseOf)
{
  const auto views = boxViewsOf(boxes, keyframe, labels_, mapOptions_);
  return objects_.add(views, boxes.timestamp, poseCovariance, poseOf);
}

BoxMeasurement QuadricBackEnd::viewFor(
    const BoxView& view, const CPose3D& T_map_robot, const Ellipsoid& object) const
{
  return view.measurementFor(T_map_robot, object, mapOptions_.poseNoise, mapOptions_.estimator);
}

CPose3D QuadricBackEnd::addKeyframe(
    const CPose3D& T_odom_robot,
    const std::optional<CPose3DPDFGaussian>& step,
    const CObservationObjects* boxes,
    SlamResult& result)
{
  const auto motion = odometry_.next(T_odom_robot);
  const std::size_t pose = graph_.addPose(
      correctPoses_ && motion ? graph_.pose(graph_.poses() - 1) + *motion : T_odom_robot);
  if (pose > 0 && step) graph_.addStep(pose - 1, pose, stiffAtRest(*step));
  if (!boxes) return graph_.pose(pose);

  const auto window = static_cast<std::size_t>(options_.window);
  const std::size_t firstFree = pose < window ? 1 : pose + 1 - window;
  const auto poseOf = [&](std::size_t k) { return graph_.pose(k); };
  const Matrix6 poseCovariance =
      correctPoses_ ? graph_.marginals(firstFree, false).lastPose : Matrix6(Matrix6::Zero());
  const Decisions decisions = associate(*boxes, pose, poseCovariance, poseOf);
  for (const auto& decision : decisions)
    result.decisions.push_back({static_cast<std::uint32_t>(pose), decision});
  if (correctPoses_)
    for (const auto& decision : decisions)
      if (decision.object) addToWindow(*decision.object, pose, decision.startedObject);
  const auto merged = objects_.mergeOverlapping(poseOf);
  follow(merged, result.decisions);
  if (!correctPoses_) return graph_.pose(pose);

  for (const auto& [kept, absorbed] : merged)
  {
    cameras_.erase(absorbed);
    graph_.removeObject(absorbed, kept);
  }
  graph_.optimiseWindow(firstFree);
  return graph_.pose(pose);
}

void QuadricBackEnd::addToWindow(ObjectId id, std::size_t keyframe, bool isNew)
{
  const QuadricObject& object = objects_.all().at(id);
  if (isNew)
    graph_.setObject(
        id, object.record.object, withEllipsoidOutline(labels_.properties(object.record.label())),
        ObjectFreedom::Free);
  for (const BoxView& seen : object.views)
  {
    if (!isNew && seen.keyframe != keyframe) continue;
    const CPose3D T_map_robot = graph_.pose(seen.keyframe);
    BoxMeasurement view = viewFor(seen, T_map_robot, object.record.object);
    const Eigen::Vector3d camera = seen.placedAt(T_map_robot).camera;
    auto& cameras = cameras_[id];
    view.weight =
        independentShare(camera, object.record.object.center(), cameras, mapOptions_.existence);
    rememberCamera(camera, cameras);
    graph_.addView(seen.keyframe, id, view);
  }
}

FactorGraph QuadricBackEnd::globalGraph(const SlamResult& result) const
{
  FactorGraph graph(graphWithoutFloor(options_, mapOptions_.estimator, GraphScope::WholeRun));
  for (std::size_t k = 0; k < result.keyframes.size(); ++k)
  {
    const Keyframe& keyframe = result.keyframes[k];
    graph.addPose(keyframe.T_map_robot);
    if (k > 0 && keyframe.odometryStep)
      graph.addStep(k - 1, k, stiffAtRest(*keyframe.odometryStep));
  }
  for (const auto& [id, object] : objects_.all())
  {
    if (object.waits) continue;  // there are tracks when no round went before
    graph.setObject(
        id, object.record.object, withEllipsoidOutline(labels_.properties(object.record.label())),
        ObjectFreedom::Free);
    std::vector<Eigen::Vector3d> cameras;
    for (const auto& view : object.views)
      cameras.push_back(view.placedAt(graph.pose(view.keyframe)).camera);
    const auto shares =
        independentShares(cameras, object.record.object.center(), mapOptions_.existence);
    for (std::size_t i = 0; i < object.views.size(); ++i)
    {
      const BoxView& seen = object.views[i];
      BoxMeasurement view = viewFor(seen, graph.pose(seen.keyframe), object.record.object);
      view.weight = shares[i];
      graph.addView(seen.keyframe, id, view);
    }
  }
  return graph;
}

double QuadricBackEnd::round(const BoxesOf& boxesOf, SlamResult& result)
{
  const auto poseOf = [&](std::size_t k) { return result.keyframes[k].T_map_robot; };
  result.decisions.clear();
  objects_.beginRound();
  for (std::size_t k = 0; k < result.keyframes.size(); ++k)
    if (const auto boxes = boxesOf(k))
      for (const auto& decision : associate(*boxes, k, Matrix6::Zero(), poseOf))
        result.decisions.push_back({static_cast<std::uint32_t>(k), decision});
  follow(objects_.mergeOverlapping(poseOf), result.decisions);
  objects_.endRound();

  FactorGraph graph = globalGraph(result);
  const auto poseInGraph = [&](std::size_t k) { return graph.pose(k); };
  CPose3D T_map_graph;
  if (correctPoses_)
  {
    graph.optimise();
    T_map_graph = alignmentWithOdometry(poseInGraph, result.keyframes);
  }
  else
    graph.optimiseObjects();
  const double farthest = movePoses(T_map_graph, poseInGraph, result.keyframes);
  const auto marginals = correctPoses_ ? graph.marginals(0, true).objects : graph.objectMarginals();
  for (const auto& [id, covariance] : marginals)
    objects_.settle(id, graph.object(id).transformed(T_map_graph), covariance);
  return farthest;
}

void QuadricBackEnd::finish(const BoxesOf& boxesOf, SlamResult& result)
{
  CorrectionSummary summary;
  for (std::size_t k = 0; k < result.keyframes.size(); ++k)
    result.keyframes[k].T_map_robot = graph_.pose(k);
  for (; summary.rounds < options_.rounds && !summary.converged; ++summary.rounds)
  {
    const auto before = result.decisions;
    summary.lastMove = round(boxesOf, result);
    summary.converged = summary.lastMove < options_.smallMove &&
                        (correctPoses_ || isSame(before, result.decisions));
  }
  if (correctPoses_) result.correction = summary;
  fillMap(result);
}

void QuadricBackEnd::fillMap(SlamResult& result) const
{
  const auto poseOf = [&](std::size_t k) { return result.keyframes[k].T_map_robot; };
  result.map.clear();
  std::map<ObjectId, ObjectId> idInMap;
  for (const auto& [id, object] : objects_.all())
    if (!object.waits) idInMap[id] = result.map.addObject(objects_.finished(object, poseOf));
  for (auto& [keyframe, decision] : result.decisions)
  {
    const auto known = decision.object ? idInMap.find(*decision.object) : idInMap.end();
    decision.object = known == idInMap.end() ? std::nullopt : std::optional(known->second);
    decision.startedObject &= decision.object.has_value();
  }
  FactorGraph graph = globalGraph(result);
  result.edges = graph.graphEdges();
  if (correctPoses_) noteMarginals(graph, result.keyframes);
  for (auto& edge : result.edges) edge.object = idInMap.at(edge.object);
}

}  // namespace quadmap
