#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/dense/DenseCloud.h"
#include "quadmap/dense/DenseOptions.h"
#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
class OutputGroup;
class OutputSet;

/** The points of one object of a map, as the depth images and the detector's boxes tell them: what
 * lies in its boxes, stands on its support and hangs together. The map says which boxes are of the
 * object and about where it is, but nothing about its size. */
struct ObjectPoints
{
  ObjectRecord record;                  //!< As the map has it
  DenseCloud cloud;                     //!< Empty when nothing was found
  std::vector<float> weights;           //!< Of each point: how much was measured there
  std::optional<double> supportHeight;  //!< z of the surface it stands on, in the map [m]
  /** Where the cameras of its boxes were, in the map [m]. */
  std::vector<Eigen::Vector3d> eyes;
  std::size_t boxesWithTop = 0;  //!< Number of these boxes whose upper edge is the object's
  /** Points near by of other things, in the map [m]: neither the object's nor of what it stands on
   * or at. */
  std::vector<Eigen::Vector3f> others;
};

/** Finds the points of all objects of a run, in their order.
 * \param result Folder of quadmap-slam: map.simplemap, objects.simplemap and report.json are read.
 * \param objects The objects of its map.
 * \param progress Called with the share of the keyframes that is done, in [0, 1].
 * \exception std::runtime_error For files that cannot be read, and without PCL. */
std::vector<ObjectPoints> findObjectPoints(
    const std::string& result,
    const std::vector<ObjectRecord>& objects,
    const DenseOptions& options,
    const std::function<void(double)>& progress);

/** ID_LABEL and an extension, where everything but letters, digits and '-' is '_', and LABEL ends
 * after 64 bytes. */
std::string fileNameOf(const ObjectRecord& record, const std::string& extension);

/** Has the commit of a set remove the files of its folder that an earlier call wrote for objects
 * and that are not in the set. Call it when all files were added. \param extension ".pcd" or
 * ".png". */
void removeFormerFiles(OutputSet& files, const std::string& extension);

/** Writes the cloud of each object that has points to FOLDER/ID_LABEL.pcd; the clouds of an earlier
 * call are removed. The folder is made when missing.
 * \param group The clouds appear when it is committed.
 * \return The names of the files.
 * \exception std::runtime_error If they cannot be written. */
std::vector<std::string> writeObjectClouds(
    const std::vector<ObjectPoints>& objects, const std::string& folder, OutputGroup& group);

}  // namespace quadmap
