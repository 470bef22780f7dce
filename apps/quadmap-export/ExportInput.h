#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadmap/review/SceneContent.h"

namespace quadmap
{
struct ExportInput
{
  std::string path;                      //!< OUTDIR of quadmap-slam, or one objects.quadmap
  std::optional<std::string> truthPath;  //!< True objects in the form of objects.json
  bool withCloud = true;                 //!< Read map.simplemap if it exists
};

/** Reads what a scene can show. For a folder this is objects.quadmap and, where they exist,
 * trajectory.tum, trajectory_odometry.tum and map.simplemap. For a file it is the objects alone.
 * \exception std::runtime_error If a file cannot be read. The message names it. */
SceneContent readExportInput(const ExportInput& input);

}  // namespace quadmap
