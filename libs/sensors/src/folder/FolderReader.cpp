#include "folder/FolderReader.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "quadmap/obs/Trajectory.h"
#include "text/TextLines.h"
#include "tum/TumFiles.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

FolderCamera givenCamera(const std::string& what)
{
  return fs::path(what).extension() == ".yaml" ? readTumCalibration(what) : cameraPreset(what);
}

FolderCamera findCamera(
    const std::string& folder, const FrameFolderOptions& options, const std::string& usual)
{
  if (!options.camera.empty()) return givenCamera(options.camera);
  const std::string file = (fs::path(folder) / "calibration.yaml").string();
  if (fs::exists(file)) return readTumCalibration(file);
  if (!usual.empty()) return cameraPreset(usual);
  if (const auto name = presetOfFolder(folder)) return cameraPreset(*name);
  std::string known;
  for (const auto& name : cameraPresetNames()) known += (known.empty() ? "" : ", ") + name;
  throw std::runtime_error(
      file + ": no such file, and the folder's name tells no camera; --camera gives one: " + known +
      ", or a file");
}

void requireInOrder(const Trajectory& trajectory, const std::string& file)
{
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    if (trajectory[i].time < trajectory[i - 1].time)
      throw std::runtime_error(mrpt::format(
          "%s: pose %zu: time goes back from %.6f to %.6f s", file.c_str(), i,
          trajectory[i - 1].time, trajectory[i].time));
}
}  // namespace

FolderCamera cameraOfFolder(
    const std::string& folder,
    const FrameFolderOptions& options,
    const std::string& usual,
    double depthFactor)
{
  FolderCamera camera = findCamera(folder, options, usual);
  if (camera.depthFactor == 0) camera.depthFactor = depthFactor;
  return camera;
}

void takePoses(FolderContent& content, const std::string& file, double maxGap)
{
  const Trajectory trajectory = readTumTrajectory(file);
  requireInOrder(trajectory, file);
  content.poses = fs::path(file).filename().string();
  std::size_t without = 0;
  for (auto& frame : content.frames)
  {
    frame.T_world_optical = poseAt(trajectory, frame.time, maxGap);
    if (!frame.T_world_optical) ++without;
  }
  if (without > 0)
    content.notes.push_back(mrpt::format(
        "%s: no pose for %zu of %zu frames", file.c_str(), without, content.frames.size()));
}

}  // namespace quadmap
