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
  std::optional<std::string> truthPath;  //!< True objects, form of objects.json
  bool withCloud = true;                 //!< Read map.simplemap, where there is one
};

/** Reads what there is to see: of a folder its objects.quadmap and, where they exist,
 * trajectory.tum, trajectory_odometry.tum and map.simplemap; of a file the objects alone.
 * \exception std::runtime_error Names the file. */
SceneContent readExportInput(const ExportInput& input);

}  // namespace quadmap
