#include "sevenscenes/SevenScenesFolder.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "frames/FolderReader.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr double kSevenScenesDepthFactor = 1000;
constexpr std::uint16_t kNoDepth = 65535;
constexpr double kSevenScenesImagesPerSecond = 30;
const std::string kPrefix = "frame-";

/** The number of an image of a folder by the end of its name, such as 16 of
 * "frame-000016.depth.png" and ".depth.png"; nothing for other files. */
std::optional<int> numberOf(const fs::path& file, const std::string& end)
{
  const std::string name = file.filename().string();
  if (name.size() <= kPrefix.size() + end.size() || name.rfind(kPrefix, 0) != 0 ||
      name.compare(name.size() - end.size(), end.size(), end) != 0)
    return std::nullopt;
  int number = 0;
  const char* const last = name.data() + name.size() - end.size();
  const auto [stop, error] = std::from_chars(name.data() + kPrefix.size(), last, number);
  if (error != std::errc() || stop != last || number < 0) return std::nullopt;
  return number;
}

/** The number of a file whose name ends like one of these. */
std::optional<int> numberOf(const fs::path& file, const std::vector<std::string>& ends)
{
  for (const auto& end : ends)
    if (const auto number = numberOf(file, end)) return number;
  return std::nullopt;
}

/** The files of a folder by their numbers. */
using NumberedFiles = std::map<int, std::string>;

/** Those whose names end like one of these. */
NumberedFiles filesOf(
    const std::string& folder,
    const std::vector<std::string>& ends,
    std::vector<std::string>& problems)
{
  NumberedFiles files;
  for (const auto& file : filesIn(folder))
    if (const auto number = numberOf(file, ends)) addNumbered(files, *number, file, problems);
  return files;
}

const std::vector<std::string> kColorEnds = {".color.png", ".color.jpg"},
                               kDepthEnds = {".depth.png"};

void readPoses(FolderContent& content, const NumberedFiles& files)
{
  content.poses = "frame-*.pose.txt";
  for (auto& frame : content.frames)
  {
    const auto file =
        files.find(static_cast<int>(std::lround(frame.time * kSevenScenesImagesPerSecond)));
    if (file == files.end()) continue;
    takeMatrixPose(frame, file->second);
    if (frame.T_world_optical && content.camera.posesAreOfDepth)
      frame.T_world_optical = *frame.T_world_optical + (-content.camera.depth->T_color_depth);
  }
}

/** Collections such as 3DMatch have a matrix of the depth camera in the folder or above, which does
 * not say where the colour camera is. */
void noteUnreadCamera(FolderContent& content)
{
  std::error_code ignored;  // a link in a circle is no such file
  const fs::path folder = content.folder, whole = fs::weakly_canonical(folder, ignored);
  for (const fs::path& place : {folder, whole.parent_path()})
  {
    const fs::path file = place / "camera-intrinsics.txt";
    if (!fs::exists(file, ignored)) continue;
    content.notes.push_back(
        file.string() +
        ": is not read, as the camera is that of 7-Scenes; --camera FILE.ini gives another");
    return;
  }
}
}  // namespace

bool isSevenScenesFolder(const std::string& folder)
{
  const auto files = filesIn(folder);
  const auto has = [&](const std::vector<std::string>& ends)
  {
    return std::any_of(
        files.begin(), files.end(), [&](const fs::path& file) { return numberOf(file, ends); });
  };
  return has(kColorEnds) && has(kDepthEnds);
}

FolderContent readSevenScenesFolder(const std::string& folder, const FrameFolderOptions& options)
{
  FolderContent content;
  content.folder = folder;
  content.camera = cameraOfFolder(folder, options, "7scenes", kSevenScenesDepthFactor);
  if (options.camera.empty() && !fs::exists(fs::path(folder) / "calibration.yaml"))
    noteUnreadCamera(content);
  // A calibration.yaml and the cameras known by name have the factor of registered images.
  if (fs::path(options.camera).extension() != ".ini")
    content.camera.depthFactor = kSevenScenesDepthFactor;
  if (content.camera.noDepth == 0) content.camera.noDepth = kNoDepth;
  content.camera.posesAreOfDepth = content.camera.depth.has_value();
  const auto colors = filesOf(folder, kColorEnds, content.listProblems),
             depths = filesOf(folder, kDepthEnds, content.listProblems);
  for (const auto& [number, color] : colors)
    if (const auto depth = depths.find(number); depth != depths.end())
      content.frames.push_back(
          {number / kSevenScenesImagesPerSecond,
           color,
           depth->second,
           fs::path(color).filename().string(),
           {}});
  requireFrames(content, "has no pair of frame-*.color.png (or .jpg) and frame-*.depth.png");
  addUnpaired(content, colors, depths);
  content.pairing = "of equal numbers";
  if (const auto poses = filesOf(folder, {".pose.txt"}, content.posesProblems); !poses.empty())
    readPoses(content, poses);
  else
    content.notes.push_back(folder + ": no frame-*.pose.txt, hence no poses");
  return content;
}

}  // namespace quadmap
