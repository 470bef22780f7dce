#include "icl/IclFolder.h"

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "frames/FolderReader.h"
#include "tum/TumFiles.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr double kIclDepthFactor = 5000;
constexpr double kIclImagesPerSecond = 1;  // as the trajectories count

/** Files with trajectories of ICL-NUIM. */
std::vector<std::string> trajectoriesIn(const std::string& folder)
{
  const std::string end = ".gt.freiburg";
  std::vector<std::string> files;
  for (const auto& file : filesIn(folder))
  {
    const std::string name = file.filename().string();
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0)
      files.push_back(file.string());
  }
  return files;
}

std::string findTrajectory(const std::string& folder)
{
  const auto files = trajectoriesIn(folder);
  if (files.size() > 1)
    throw std::runtime_error(
        folder + ": has several trajectories, such as " + files[0] + " and " + files[1] +
        "; leave the one of these images");
  if (!files.empty()) return files[0];
  const std::string usual = (fs::path(folder) / "groundtruth.txt").string();
  return fs::exists(usual) ? usual : std::string();
}
}  // namespace

bool isIclFolder(const std::string& folder)
{
  return !trajectoriesIn(folder).empty() || presetOfFolder(folder) == "icl";
}

FolderContent readIclFolder(const std::string& folder, const FrameFolderOptions& options)
{
  FolderContent content;
  content.folder = folder;
  content.camera = cameraOfFolder(folder, options, "icl", kIclDepthFactor);
  takeDepthAsRegistered(content);  // rendered by one camera
  if (fs::exists(fs::path(folder) / "associations.txt"))
    readTumFrames(content, options.maxPairDelay);
  else
    framesByName(content, "rgb", "depth", kIclImagesPerSecond);
  const std::string poses = findTrajectory(folder);
  if (poses.empty())
    content.notes.push_back(folder + ": no *.gt.freiburg and no groundtruth.txt, hence no poses");
  else
    takePoses(content, poses, options.maxPoseGap);
  return content;
}

}  // namespace quadmap
