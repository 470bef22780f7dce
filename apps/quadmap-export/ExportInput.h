#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadmap/review/PageContent.h"
#include "quadmap/review/SceneContent.h"

namespace quadmap
{
struct ExportInput
{
  std::string path;                           //!< OUTDIR of quadmap-slam, or the file of a map
  std::optional<std::string> truthPath;       //!< True objects in the form of objects.json
  std::optional<std::string> trajectoryPath;  //!< True trajectory, in the world of the truth
  bool inPlace = false;                       //!< The truth's world is the map's
  bool withCloud = true;                      //!< Read map.simplemap if it exists
};

/** Reads what a scene can show. For a folder this is objects.quadmap and, where they exist,
 * trajectory.tum, trajectory_odometry.tum and map.simplemap. For a file it is the objects alone.
 * The truth is carried into the map's frame by the alignment of the trajectories.
 * \exception std::runtime_error If a file cannot be read, or the truth cannot be aligned. The
 * message names it. */
SceneContent readExportInput(const ExportInput& input);

/** Reads what a page can show: the same, and in a folder the keyframes' images, their boxes
 * (objects.simplemap) and what became of them (report.json). \exception std::runtime_error As
 * above. \param comparedMapPath A second map to compare with, in the same frame: a folder or a
 * file. */
PageContent readPageInput(
    const ExportInput& input, const std::optional<std::string>& comparedMapPath);

}  // namespace quadmap
