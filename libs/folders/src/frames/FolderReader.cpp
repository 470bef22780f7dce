#include "frames/FolderReader.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "frames/ResizedCamera.h"
#include "frames/RigidMatrix.h"
#include "quadmap/base/InputFile.h"
#include "quadmap/obs/Plausible.h"
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
  if (fs::path(what).extension() != ".yaml") return cameraPreset(what);
  FolderCamera camera = readTumCalibration(what);
  camera.origin = what;  // it need not be in the folder that messages are about
  return camera;
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

/** The JPEG and PNG files of a folder by the number at the end of their names. */
std::map<unsigned long, std::string> imagesIn(
    const fs::path& folder, std::vector<std::string>& problems)
{
  std::map<unsigned long, std::string> images;
  if (!fs::is_directory(folder)) return images;
  for (const auto& file : filesIn(folder))
  {
    const std::string name = file.stem().string(), extension = file.extension().string();
    if (extension != ".png" && extension != ".jpg" && extension != ".jpeg") continue;
    const auto digits = name.find_last_not_of("0123456789") + 1;  // npos + 1 is 0
    unsigned long number = 0;
    const auto result = std::from_chars(name.data() + digits, name.data() + name.size(), number);
    if (result.ec == std::errc()) addNumbered(images, number, file, problems);
  }
  return images;
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

void takeDepthAsRegistered(FolderContent& content)
{
  FolderCamera& camera = content.camera;
  if (!camera.depth) return;
  const unsigned columns = camera.depth->camera.ncols, rows = camera.depth->camera.nrows;
  if (columns == camera.color.ncols && rows == camera.color.nrows) return camera.depth.reset();
  if (camera.isDistorted())
    throw std::runtime_error(
        placeOfCamera(content) +
        ": its lens distorts, and registered depth images of another size cannot be rectified");
  camera.depth = DepthCamera{resized(camera.color, columns, rows), {}};
}

std::string placeOfCamera(const FolderContent& content)
{
  const FolderCamera& camera = content.camera;
  return camera.file.empty() ? content.folder + ": " + camera.origin : camera.file;
}

std::set<fs::path> filesIn(const fs::path& folder)
{
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().front() != '.') files.insert(entry.path());
  return files;
}

void takePoses(FolderContent& content, const std::string& file, double maxGap)
{
  content.poses = fs::path(file).filename().string();
  try
  {
    const Trajectory trajectory = readTrajectoryInOrder(file, content.posesProblems);
    if (const auto warning = warningOfCut(file); !warning.empty())
      content.notes.push_back(file + ": " + warning);
    content.posesAreRefused = trajectory.empty() && !content.posesProblems.empty();
    for (auto& frame : content.frames)
      frame.T_world_optical = poseAt(trajectory, frame.time, maxGap);
  }
  catch (const std::exception& e)
  {
    content.posesProblems = {e.what()};
    content.posesAreRefused = true;
  }
}

void requireFrames(const FolderContent& content, const std::string& without)
{
  if (content.frames.empty())
    throw std::runtime_error(
        content.listProblems.empty() ? content.folder + ": " + without
                                     : content.listProblems.front());
}

void framesByName(
    FolderContent& content,
    const std::string& colorFolder,
    const std::string& depthFolder,
    double rate)
{
  const auto images = [&](const std::string& name)
  { return imagesIn(fs::path(content.folder) / name, content.listProblems); };
  const auto colors = images(colorFolder), depths = images(depthFolder);
  for (const auto& [number, color] : colors)
    if (const auto depth = depths.find(number); depth != depths.end())
    {
      if (static_cast<double>(number) > kLatestTime * rate)
      {
        noteUnusable(content.listProblems, content.folder, color + ": its number is too large");
        continue;
      }
      content.frames.push_back(
          {static_cast<double>(number) / rate,
           color,
           depth->second,
           colorFolder + "/" + fs::path(color).filename().string(),
           {}});
    }
  requireFrames(
      content, "has no images of equal numbers in " + colorFolder + "/ and " + depthFolder + "/");
  addUnpaired(content, colors, depths);
  content.pairing = "of equal numbers";
}

Eigen::Matrix4d readMatrix(const std::string& path)
{
  const auto lines = readTextLines(path);
  if (lines.size() != 4)
    throw std::runtime_error(
        mrpt::format("%s: expected 4 lines, got %zu", path.c_str(), lines.size()));
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row)
  {
    const auto& line = lines[static_cast<std::size_t>(row)];
    requireColumns(line, 4);
    for (int column = 0; column < 4; ++column)
      matrix(row, column) = numberIn(line, static_cast<std::size_t>(column));
  }
  return matrix;
}

std::optional<mrpt::poses::CPose3D> readMatrixPose(const std::string& path)
{
  const Eigen::Matrix4d matrix = readMatrix(path);
  if (!matrix.allFinite() || matrix.isZero(0)) return std::nullopt;
  if (!isRigid(matrix)) throw std::runtime_error(path + ": is no rigid transformation");
  const auto pose = poseOf(matrix);
  if (const auto why = whyNoPose(pose)) throw std::runtime_error(path + ": " + *why);
  return pose;
}

void takeMatrixPose(FolderFrame& frame, const std::string& path)
try
{
  frame.T_world_optical = readMatrixPose(path);
}
catch (const std::exception& e)
{
  frame.poseProblem = e.what();
}

}  // namespace quadmap
