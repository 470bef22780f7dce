#include "PointBackEnd.h"

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/PoseAngles.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
PointOptions pointOptions(const SlamConfiguration& configuration)
{
  PointOptions options = configuration.point;
  options.alpha = configuration.mapInsertion.association.alpha;
  options.beta = configuration.mapInsertion.association.beta;
  options.rounds = configuration.joint.rounds;
  options.smallMove = configuration.joint.smallMove;
  options.maxIterations = configuration.joint.maxIterations;
  options.associationGiven = configuration.slam.association == AssociationSource::Given;
  return options;
}

PointPose<3> pointPose(const CPose3D& pose)
{
  return {
      pose.getRotationMatrix().asEigen(), {pose.x(), pose.y(), pose.z()}
  };
}

CPose3D mrptPose(const PointPose<3>& pose)
{
  return CPose3D(
      mrpt::math::CMatrixDouble33(pose.R),
      mrpt::math::TPoint3D(pose.t.x(), pose.t.y(), pose.t.z()));
}

PointOdometry<3> odometryOf(const CPose3DPDFGaussian& step)
{
  PoseIncrementMatrix<3> J = PoseIncrementMatrix<3>::Identity();
  J.bottomRightCorner<3, 3>() = localTurnsPerAngle(step.mean);
  return {pointPose(step.mean), J * step.cov.asEigen() * J.transpose()};
}

}  // namespace

PointBackEnd::PointBackEnd(
    const SlamConfiguration& configuration, bool correctPoses, const LabelTable& labels) :
    correctPoses_(correctPoses),
    associationGiven_(configuration.slam.association == AssociationSource::Given),
    centerSigma_(configuration.point.centerSigma),
    labels_(labels),
    slam_(pointOptions(configuration), !correctPoses)
{
}

std::vector<PointMeasurement<3>> PointBackEnd::measure(
    const CObservationObjects& boxes, const CPose3D& T_map_robot)
{
  PoseNoise exact;
  exact.position = exact.angle = 0;
  const PointPose<3> robot = pointPose(T_map_robot);
  std::vector<PointMeasurement<3>> result;
  for (std::size_t b = 0; b < boxes.objects.size(); ++b)
  {
    const DetectedObject& detected = boxes.objects[b];
    const auto view = viewOf(
        detected, T_map_robot + boxes.sensorPose,
        labels_.properties(labels_.canonical(detected.label)), exact);
    if (!view || (!view->complete && !detected.measurement.seed_sensor)) continue;
    PointMeasurement<3> z;
    z.position = robot.inverse() * view->center;
    z.covariance = robot.R.transpose() * view->centerCovariance * robot.R;
    z.covariance.diagonal().array() += centerSigma_ * centerSigma_;
    z.label = view->label;
    if (associationGiven_) z.instance = detected.instanceId;
    result.push_back(z);

    Eigen::Vector3d halfSizes = view->halfSizes;
    std::sort(halfSizes.data(), halfSizes.data() + 2);
    seen_.back().push_back({b, view->complete, halfSizes, boxes.timestamp});
  }
  return result;
}

CPose3D PointBackEnd::addKeyframe(
    const CPose3D& T_odom_robot,
    const std::optional<CPose3DPDFGaussian>& step,
    const CObservationObjects* boxes,
    SlamResult&)
{
  const auto motion = odometry_.next(T_odom_robot);
  const CPose3D predicted =
      correctPoses_ && motion ? mrptPose(slam_.pose()) + *motion : T_odom_robot;
  CPose3DPDFGaussian uncertain;
  if (motion) uncertain.mean = *motion;
  uncertain.cov.setIdentity();
  if (step) uncertain.cov = stiffAtRest(*step).cov;
  seen_.emplace_back();
  std::vector<PointMeasurement<3>> measurements;
  if (boxes) measurements = measure(*boxes, predicted);
  slam_.addFrame(odometryOf(uncertain), measurements, pointPose(T_odom_robot));
  return correctPoses_ ? mrptPose(slam_.pose()) : T_odom_robot;
}

void PointBackEnd::finish(const BoxesOf&, SlamResult& result)
{
  if (seen_.empty()) return;
  slam_.finish();
  const PointResult<3> found = slam_.result();
  CPose3D T_map_graph;
  if (correctPoses_)
  {
    const auto poseInGraph = [&](std::size_t k) { return mrptPose(found.poses[k]); };
    T_map_graph = alignmentWithOdometry(poseInGraph, result.keyframes);
    movePoses(T_map_graph, poseInGraph, result.keyframes);
    result.correction = CorrectionSummary{found.rounds, found.lastMove, found.converged, {}};
  }
  noteDecisions(found, result);
  fillMap(found, T_map_graph, result);
}

void PointBackEnd::noteDecisions(const PointResult<3>& found, SlamResult& result) const
{
  result.decisions.clear();
  for (std::size_t k = 0; k < seen_.size(); ++k)
    for (std::size_t m = 0; m < seen_[k].size(); ++m)
    {
      const PointDecision& d = found.decisions[k][m];
      CQuadricObjectMap::Decision decision;
      decision.box = seen_[k][m].box;
      if (d.object) decision.object = static_cast<ObjectId>(*d.object);
      decision.startedObject = d.startedObject;
      decision.logPosterior = d.logPosterior;
      decision.logPosteriorSecond = d.logPosteriorSecond;
      result.decisions.push_back({static_cast<std::uint32_t>(k), decision});
    }
}

void PointBackEnd::fillMap(
    const PointResult<3>& found, const CPose3D& T_map_graph, SlamResult& result) const
{
  std::vector<std::vector<Seen>> seen(found.objects.size());
  for (std::size_t k = 0; k < seen_.size(); ++k)
    for (std::size_t m = 0; m < seen_[k].size(); ++m)
      if (const auto& object = found.decisions[k][m].object) seen[*object].push_back(seen_[k][m]);

  result.map.clear();
  std::vector<std::optional<ObjectId>> idInMap(found.objects.size());
  for (std::size_t i = 0; i < found.objects.size(); ++i)
    if (found.objects[i].confirmed)
      idInMap[i] = result.map.addObject(mapObjectOf(found.objects[i], seen[i], T_map_graph));
  for (auto& [keyframe, decision] : result.decisions)
  {
    if (decision.object) decision.object = idInMap[*decision.object];
    decision.startedObject &= decision.object.has_value();
  }
}

MapObject PointBackEnd::mapObjectOf(
    const PointObject<3>& object, const std::vector<Seen>& seen, const CPose3D& T_map_graph) const
{
  constexpr double kAnyYaw = 3.3;  // variance of an angle of which nothing is known [rad^2]
  const PointPose<3> graph = pointPose(T_map_graph);
  MapObject result;
  result.labelCounts = object.labelCounts;
  result.existenceLogOdds = object.existenceLogOdds;
  result.orientationDefined = false;
  result.firstSeen = seen.front().time;
  result.lastSeen = seen.back().time;

  const bool anyComplete =
      std::any_of(seen.begin(), seen.end(), [](const Seen& s) { return s.complete; });
  std::array<std::vector<double>, 3> halfSizes;
  for (const Seen& s : seen)
  {
    ++(s.complete ? result.completeCount : result.partialCount);
    if (s.complete != anyComplete) continue;  // a complete one measured what others assume
    for (std::size_t i = 0; i < 3; ++i)
      halfSizes[i].push_back(s.halfSizes[static_cast<Eigen::Index>(i)]);
  }
  const Eigen::Vector3d center = graph * object.position;
  result.object = Ellipsoid(
      CPose3D(center.x(), center.y(), center.z(), 0, 0, 0),
      {median(halfSizes[0]), median(halfSizes[1]), median(halfSizes[2])});

  const double spread = labels_.properties(result.label()).sizeSpread;
  result.covariance.setZero();
  result.covariance.topLeftCorner<3, 3>() = graph.R * object.covariance * graph.R.transpose();
  result.covariance(3, 3) = kAnyYaw;
  // Without a complete measurement the sizes are the label's.
  const double measured = anyComplete ? static_cast<double>(halfSizes[0].size()) : 1;
  result.covariance.diagonal().tail<3>().setConstant(spread * spread / measured);
  return result;
}

}  // namespace quadmap
