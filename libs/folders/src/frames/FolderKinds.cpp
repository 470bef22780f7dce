#include "quadmap/folders/FolderKinds.h"

#include <mrpt/core/format.h>

#include <filesystem>
#include <stdexcept>

#include "frames/FolderReader.h"
#include "frames/FrameRectification.h"
#include "icl/IclFolder.h"
#include "pcd/PcdFolder.h"
#include "quadmap/base/InsideFolder.h"
#include "quadmap/obs/Plausible.h"
#include "quadmap/obs/UnusableLines.h"
#include "scannet/ScanNetFolder.h"
#include "sevenscenes/SevenScenesFolder.h"
#include "tum/TumFiles.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** In the order in which they are tried. */
constexpr FolderReader kReaders[] = {
    {    "icl",                                     "*.gt.freiburg",         isIclFolder,readIclFolder                                                                                         },
    {    "tum",        "associations.txt, or rgb.txt and depth.txt",         isTumFolder,     readTumFolder},
    {"7scenes", "frame-*.color.png (or .jpg) and frame-*.depth.png", isSevenScenesFolder,
     readSevenScenesFolder                                                                                 },
    {"scannet",                          "color/, depth/ and pose/",     isScanNetFolder, readScanNetFolder},
    {    "pcd",                                             "*.pcd",         isPcdFolder,     readPcdFolder},
};

const FolderReader& readerOf(const std::string& kind)
{
  for (const auto& reader : kReaders)
    if (kind == reader.kind) return reader;
  throw std::invalid_argument(kind + ": no such kind of folder");
}

void requireFolder(const std::string& folder)
{
  if (!fs::is_directory(folder)) throw std::runtime_error(folder + ": no such folder");
}

/** The image of a frame that is, or lies behind, a link out of the folder; nothing when none is.
 * \exception std::runtime_error If one cannot be followed; says why. */
std::optional<std::string> imageOutside(const FolderFrame& frame, const std::string& folder)
{
  for (const std::string& file : {frame.color, frame.depth})
    if (!isInside(file, folder)) return file;
  return std::nullopt;
}

/** A folder may come from somebody else, and its images go into a rawlog, which is passed on.
 * An image whose links cannot be followed becomes a problem of the list.
 * \exception std::runtime_error If an image is, or lies behind, a link out of the folder, if too
 * many links cannot be followed, or if no frame is left. */
void keepOwnImages(FolderContent& content, const FrameFolderOptions& options)
{
  if (options.imagesAnywhere) return;
  std::vector<FolderFrame> own;
  for (const auto& frame : content.frames)
  {
    std::optional<std::string> outside;
    try
    {
      outside = imageOutside(frame, content.folder);
    }
    catch (const std::runtime_error& e)
    {
      noteUnusable(content.listProblems, content.folder, e.what() + (" (" + frame.listed + ")"));
      continue;
    }
    if (outside)
      throw std::runtime_error(
          *outside + ": is a link out of " + content.folder + " (" + frame.listed +
          (options.imagesHint.empty() ? ")" : "; " + options.imagesHint + " allows that)"));
    own.push_back(frame);
  }
  if (own.empty()) throw std::runtime_error(content.listProblems.front());
  content.frames = std::move(own);
}

void check(const FrameFolderOptions& o)
{
  if (!(o.maxPairDelay > 0))
    throw std::invalid_argument(mrpt::format("maxPairDelay=%g: must be > 0 s", o.maxPairDelay));
  if (!(o.maxPoseGap > 0))
    throw std::invalid_argument(mrpt::format("maxPoseGap=%g: must be > 0 s", o.maxPoseGap));
}

/** \exception std::runtime_error For a calibration that the readers of a rawlog would refuse, and
 * for a lens that cannot be rectified. */
void requireCamera(const FolderContent& content)
{
  const FolderCamera& camera = content.camera;
  const auto require = [&](const std::optional<std::string>& why, const char* what)
  {
    if (why) throw std::runtime_error(placeOfCamera(content) + ": " + what + *why);
  };
  require(whyNoCalibration(camera.color), "");
  require(whyNotRectifiable(camera), "");
  if (!camera.depth) return;
  require(whyNoCalibration(camera.depth->camera), "the depth camera ");
  require(whyNoPose(camera.depth->T_color_depth, kFarthestOnRobot), "the depth camera ");
}

/** Replaces the poses that the readers of a rawlog would refuse by what is wrong with them. */
void removeImplausiblePoses(FolderContent& content)
{
  for (auto& frame : content.frames)
  {
    if (!frame.T_world_optical) continue;
    const auto why = whyNoPose(*frame.T_world_optical);
    if (!why) continue;
    frame.poseProblem =
        (std::filesystem::path(content.folder) / frame.listed).string() + ": its pose " + *why;
    frame.T_world_optical.reset();
  }
}
}  // namespace

std::vector<std::string> folderKinds()
{
  std::vector<std::string> kinds;
  for (const auto& reader : kReaders) kinds.emplace_back(reader.kind);
  return kinds;
}

std::string kindOfFolder(const std::string& folder)
{
  requireFolder(folder);
  std::string layouts;
  for (const auto& reader : kReaders)
  {
    if (reader.matches(folder)) return reader.kind;
    layouts += std::string(layouts.empty() ? "" : "; ") + reader.kind + " has " + reader.layout;
  }
  throw std::runtime_error(folder + ": is of no known kind (" + layouts + ")");
}

FrameFolder openFrameFolder(
    const std::string& kind, const std::string& folder, const FrameFolderOptions& options)
{
  check(options);
  const FolderReader& reader = readerOf(kind);
  requireFolder(folder);
  FolderContent content = reader.read(folder, options);
  keepOwnImages(content, options);
  content.kind = kind;
  requireCamera(content);
  removeImplausiblePoses(content);
  return FrameFolder(std::move(content), options);
}

}  // namespace quadmap
