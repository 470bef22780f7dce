#pragma once

#include <string>

#include "quadmap/review/SceneContent.h"

namespace quadmap
{
/** How the cloud of a scene is made. */
struct CloudOptions
{
  double cellSize = 0.015;         //!< One point per cube of this edge [m], > 0
  double maxCellSize = 0.04;       //!< Cells grow to this where pixels are sparse [m]
  std::size_t maxPoints = 400000;  //!< Cells grow when there would be more, > 0
  double maxRange = 4.5;           //!< Depth beyond this is too noisy to look at [m], > 0
  std::size_t maxKeyframes = 100;  //!< Spread evenly over the file, > 0
};

/** Takes cloud and cameras from the keyframes of a .simplemap. One keyframe is in memory at a time.
 * \exception std::runtime_error For a file that cannot be read; names it. */
void addKeyframes(
    const std::string& simpleMapPath, const CloudOptions& options, SceneContent& content);

}  // namespace quadmap
