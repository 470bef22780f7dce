#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "quadmap/folders/FrameFolder.h"
#include "quadmap/obs/UnusableLines.h"

namespace quadmap
{
/** How one kind of folder is recognised and read. */
struct FolderReader
{
  const char* kind;
  const char* layout;  //!< What such a folder has, for messages
  bool (*matches)(const std::string& folder);
  /** \exception std::runtime_error Names file and line. */
  FolderContent (*read)(const std::string& folder, const FrameFolderOptions& options);
};

/** The camera of a folder: the one of the options, that of calibration.yaml in the folder, or the
 * one that the folder's name stands for.
 * \param usual The name of the camera of all recordings of this kind; may be empty.
 * \param depthFactor That of all recordings of this kind, for cameras that do not tell.
 * \exception std::runtime_error If there is none, or it cannot be read. */
FolderCamera cameraOfFolder(
    const std::string& folder,
    const FrameFolderOptions& options,
    const std::string& usual,
    double depthFactor);

/** What a recording's camera is from, for messages: a file, or the folder and a camera's name. */
std::string placeOfCamera(const FolderContent& content);

/** Of recordings whose depth images are registered: their size is all that stays of the depth
 * camera. \exception std::runtime_error If the lens distorts and the size is another than that of
 * colour; names the folder. */
void takeDepthAsRegistered(FolderContent& content);

/** Sets the poses of the frames to those of a trajectory, interpolated at their times. What cannot
 * be used, be it the file or lines of it, becomes the content's posesProblems, as the rest can. */
void takePoses(FolderContent& content, const std::string& file, double maxGap);

/** \param without What is to be said of a folder without frames.
 * \exception std::runtime_error If there is none; says so, or why the first could not be used. */
void requireFrames(const FolderContent& content, const std::string& without);

/** Adds the frames of two folders inside the recording, which have images of equal names, such as
 * rgb/7.png and depth/7.png. The number at the end of the name gives order and time.
 * \param rate Images per second.
 * \exception std::runtime_error If there is none, or if too many images cannot be used. */
void framesByName(
    FolderContent& content,
    const std::string& colorFolder,
    const std::string& depthFolder,
    double rate);

/** The files of a folder in the order of their names, without hidden ones: macOS puts a "._1.png"
 * beside each 1.png on foreign disks, which is no image. */
std::set<std::filesystem::path> filesIn(const std::filesystem::path& folder);

/** Adds a file by its number, unless another one has it: then it becomes one of the problems.
 * \exception std::runtime_error If these are too many. */
template <typename Number>
void addNumbered(
    std::map<Number, std::string>& files,
    Number number,
    const std::filesystem::path& file,
    std::vector<std::string>& problems)
{
  const auto [place, isNew] = files.emplace(number, file.string());
  if (!isNew)
    noteUnusable(
        problems, file.parent_path().string(),
        file.string() + ": has the same number as " +
            std::filesystem::path(place->second).filename().string());
}

/** Adds the images of two folders that have no partner of the same number. */
template <typename Number>
void addUnpaired(
    FolderContent& content,
    const std::map<Number, std::string>& colors,
    const std::map<Number, std::string>& depths)
{
  for (const auto& [number, file] : colors)
    if (depths.count(number) == 0) content.addUnpaired(file);
  for (const auto& [number, file] : depths)
    if (colors.count(number) == 0) content.addUnpaired(file);
}

/** The pose of a text file with the 4x4 matrix of the camera in the world; nothing when it says by
 * numbers that are not finite, or all zero, that it is not known.
 * \exception std::runtime_error If it is no rigid transformation. Names the file. */
std::optional<mrpt::poses::CPose3D> readMatrixPose(const std::string& path);

/** Gives a frame the pose of a file, see readMatrixPose(). A file that cannot be read or used
 * becomes the frame's poseProblem, as the other frames can be. */
void takeMatrixPose(FolderFrame& frame, const std::string& path);

/** The matrix of a text file with 4 lines of 4 numbers, some of which may not be finite.
 * \exception std::runtime_error If it is none. Names file and line. */
Eigen::Matrix4d readMatrix(const std::string& path);

}  // namespace quadmap
