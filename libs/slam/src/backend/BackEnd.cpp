#include "BackEnd.h"

#include "GivenPoses.h"
#include "JointBackEnd.h"
#include "MergedObjects.h"
#include "PointBackEnd.h"
#include "QuadricBackEnd.h"

namespace quadmap
{
void BackEnd::insertIntoMap(
    const CObservationObjects& boxes,
    std::size_t keyframe,
    const mrpt::poses::CPose3D& T_map_robot,
    SlamResult& result,
    const PoseNoise& poseError)
{
  result.map.insertObservation(boxes, UncertainPose(T_map_robot, poseError));
  for (const auto& decision : result.map.lastDecisions())
    result.decisions.push_back({static_cast<std::uint32_t>(keyframe), decision});
  followMerged(result.map, result.decisions);
}

void BackEnd::consolidateMap(SlamResult& result)
{
  result.map.consolidate();
  followMerged(result.map, result.decisions);
}

void BackEnd::rebuildMap(const BoxesOf& boxesOf, SlamResult& result)
{
  result.map.clear();
  result.decisions.clear();
  for (std::size_t k = 0; k < result.keyframes.size(); ++k)
    if (const auto boxes = boxesOf(k))
      insertIntoMap(*boxes, k, result.keyframes[k].T_map_robot, result);
  consolidateMap(result);
}

void BackEnd::closeLoops(const BoxesOf&, const std::function<bool()>&, SlamResult&) {}

void BackEnd::correctWith(const KnownObjects&, const BoxesOf& boxesOf, SlamResult& result)
{
  rebuildMap(boxesOf, result);
}

std::unique_ptr<BackEnd> createBackEnd(
    const SlamConfiguration& configuration, const LabelTable& labels)
{
  const auto& slam = configuration.slam;
  const bool correctPoses =
      slam.odometry != PoseSource::GroundTruth && configuration.joint.correctPoses;
  if (slam.method == SlamMethod::Quadric)
  {
    InsertionOptions options = configuration.mapInsertion;
    if (slam.association == AssociationSource::Given) options.useInstanceIds = true;
    return std::make_unique<QuadricBackEnd>(configuration.joint, options, correctPoses, labels);
  }
  if (slam.method == SlamMethod::Point)
    return std::make_unique<PointBackEnd>(configuration, correctPoses, labels);
  if (slam.method == SlamMethod::Odometry || !correctPoses) return std::make_unique<GivenPoses>();
  return std::make_unique<JointBackEnd>(
      configuration.joint, configuration.mapInsertion, labels, configuration.relocalization);
}

}  // namespace quadmap
