#include "files/ResultWriter.h"

#include <functional>
#include <utility>

#include "files/PoseGraphWriter.h"
#include "files/SimpleMapWriter.h"
#include "quadmap/base/GzipStream.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/slam/PoseNodes.h"

namespace quadmap
{
namespace
{
Trajectory trajectoryOf(const std::vector<PoseNode>& nodes, mrpt::poses::CPose3D PoseNode::*pose)
{
  Trajectory trajectory;
  trajectory.reserve(nodes.size());
  for (const auto& node : nodes) trajectory.push_back({node.time, node.*pose});
  return trajectory;
}

}  // namespace

void writeResult(OutputSet& files, const RunRecord& run)
{
  const SlamResult& result = run.result;
  const std::vector<PoseNode> nodes = poseNodesOf(result.keyframes);
  const auto poses = poseDistributions(
      nodes, result.keyframes, {run.configuration.poses, run.configuration.slam.odometry});
  const auto simpleMap = [&](const std::string& path, SimpleMapContent content)
  { writeSimpleMap(path, nodes, run.spool, content, poses); };
  const auto trajectory = [&](const std::string& path, mrpt::poses::CPose3D PoseNode::*pose)
  { writeTumTrajectory(path, trajectoryOf(nodes, pose)); };

  using Write = std::function<void(const std::string&)>;
  const std::pair<const char*, Write> writers[] = {
      {        "objects.quadmap",[&](auto& path) { writeArchive(path, result.map); }                                 },
      {           "objects.json",                [&](auto& path) { writeObjectsJson(path, result.map.toRecords()); }},
      {         "trajectory.tum",                      [&](auto& path) { trajectory(path, &PoseNode::T_map_robot); }},
      {"trajectory_odometry.tum",                     [&](auto& path) { trajectory(path, &PoseNode::T_odom_robot); }},
      {          "map.simplemap",                      [&](auto& path) { simpleMap(path, SimpleMapContent::Scans); }},
      {      "objects.simplemap",                    [&](auto& path) { simpleMap(path, SimpleMapContent::Objects); }},
      {       "pose-graph.graph", [&](auto& path)
 { writePoseGraph(path, nodes, result, run.spool, run.configuration.poses); }      },
      {            "report.json",
       [&](auto& path) { writeReport(path, nodes, run); }                                                           }, // the last one, as it has the times
  };
  for (const auto& [name, write] : writers)
  {
    const auto scope = run.times.measure(std::string("write ") + name);
    write(files.add(name));
  }
}

}  // namespace quadmap
