#pragma once

#include <string>

#include "quadmap/review/SceneContent.h"

namespace quadmap
{
/** How the cloud of a scene is made. */
struct CloudOptions
{
  double cellSize = 0.015;         //!< Size of the cubes that keep one point each [m], > 0
  double maxCellSize = 0.04;       //!< Largest size of cubes where pixels are sparse [m]
  std::size_t maxPoints = 400000;  //!< Cubes grow when there would be more, > 0
  double maxRange = 4.5;           //!< Depth beyond this is ignored as noisy [m], > 0
  std::size_t maxKeyframes = 100;  //!< Largest number of keyframes, spread evenly, > 0
};

/** Adds cloud and cameras from the keyframes of a .simplemap. One keyframe is in memory at a time.
 * \exception std::runtime_error For a file that cannot be read. The message names it. */
void addKeyframes(
    const std::string& simpleMapPath, const CloudOptions& options, SceneContent& content);

}  // namespace quadmap
