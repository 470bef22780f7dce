#pragma once

#include <string>

#include "quadmap/sensors/FrameFolder.h"

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

/** Sets the poses of the frames to those of a trajectory, interpolated at their times, and says in
 * the notes for how many there is none.
 * \exception std::runtime_error If the file's times go back; names it. */
void takePoses(FolderContent& content, const std::string& file, double maxGap);

/** Colour images and depth images with equal names, such as rgb/7.png and depth/7.png: pairs in
 * the order of the numbers in their names, at `rate` images a second. Only the files are set, and
 * the times. */
std::vector<FolderFrame> framesByName(
    const std::string& colorFolder, const std::string& depthFolder, double rate);

/** The pose of a text file with the 4x4 matrix of the camera in the world; nothing when it is
 * missing, or says by numbers that are not finite or zero that it is not known.
 * \exception std::runtime_error If it is no rigid transformation. Names the file. */
std::optional<mrpt::poses::CPose3D> readMatrixPose(const std::string& path);

}  // namespace quadmap
