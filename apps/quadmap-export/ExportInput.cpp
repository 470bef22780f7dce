#include "ExportInput.h"

#include <filesystem>
#include <stdexcept>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/review/KeyframeContent.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

std::vector<mrpt::poses::CPose3D> posesOf(const fs::path& path)
{
  std::vector<mrpt::poses::CPose3D> poses;
  if (!fs::exists(path)) return poses;
  for (const StampedPose& stamped : readTumTrajectory(path.string())) poses.push_back(stamped.pose);
  return poses;
}

}  // namespace

SceneContent readExportInput(const ExportInput& input)
{
  const fs::path path = input.path;
  if (!fs::exists(path)) throw std::runtime_error(input.path + ": there is no such file or folder");
  const bool isFolder = fs::is_directory(path);
  const fs::path mapPath = isFolder ? path / "objects.quadmap" : path;
  if (!fs::exists(mapPath))
    throw std::runtime_error(mapPath.string() + ": is missing; is this a folder of quadmap-slam?");

  SceneContent content;
  CQuadricObjectMap map;
  map.loadFromFile(mapPath.string());
  content.objects = map.toRecords();
  if (input.truthPath) content.truth = readObjectsJson(*input.truthPath);
  if (!isFolder) return content;
  content.trajectory = posesOf(path / "trajectory.tum");
  content.odometry = posesOf(path / "trajectory_odometry.tum");
  const fs::path keyframes = path / "map.simplemap";
  if (input.withCloud && fs::exists(keyframes)) addKeyframes(keyframes.string(), {}, content);
  return content;
}

}  // namespace quadmap
