#include "quadmap/slam/ResultWriter.h"

#include <functional>
#include <utility>

#include "quadmap/obs/GzipStream.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/slam/PoseGraphWriter.h"
#include "quadmap/slam/SimpleMapWriter.h"

namespace quadmap
{
namespace
{
Trajectory trajectoryOf(
    const std::vector<Keyframe>& keyframes, mrpt::poses::CPose3D Keyframe::*pose)
{
  Trajectory trajectory;
  trajectory.reserve(keyframes.size());
  for (const auto& keyframe : keyframes) trajectory.push_back({keyframe.time, keyframe.*pose});
  return trajectory;
}

}  // namespace

std::vector<std::string> writeResult(const std::string& directory, const RunRecord& run)
{
  const SlamResult& result = run.result;
  const auto simpleMap = [&](const std::string& path, SimpleMapContent content)
  {
    const PoseCovarianceChain covariances(run.configuration.poses, run.configuration.slam.odometry);
    writeSimpleMap(path, result.keyframes, run.spool, content, covariances);
  };
  const auto trajectory = [&](const std::string& path, mrpt::poses::CPose3D Keyframe::*pose)
  { writeTumTrajectory(path, trajectoryOf(result.keyframes, pose)); };

  using Write = std::function<void(const std::string&)>;
  const std::pair<const char*, Write> writers[] = {
      {        "objects.quadmap",[&](auto& path) { writeArchive(path, result.map); }                                 },
      {           "objects.json", [&](auto& path) { writeObjectsJson(path, result.map.toRecords()); }},
      {         "trajectory.tum",       [&](auto& path) { trajectory(path, &Keyframe::T_map_robot); }},
      {"trajectory_odometry.tum",      [&](auto& path) { trajectory(path, &Keyframe::T_odom_robot); }},
      {          "map.simplemap",       [&](auto& path) { simpleMap(path, SimpleMapContent::Scans); }},
      {      "objects.simplemap",     [&](auto& path) { simpleMap(path, SimpleMapContent::Objects); }},
      {       "pose-graph.graph",
       [&](auto& path) { writePoseGraph(path, result, run.spool, run.configuration.poses); }         },
      {            "report.json",                         [&](auto& path) { writeReport(path, run); }}, // last: it has the times
  };
  std::vector<std::string> files;
  for (const auto& [name, write] : writers)
  {
    const auto scope = run.times.measure(std::string("write ") + name);
    files.push_back(directory + "/" + name);
    write(files.back());
  }
  return files;
}

}  // namespace quadmap
