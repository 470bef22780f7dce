#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <functional>
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

/** Gets each scan with where it was taken, and the number of keyframes of the whole file. */
using KeyframeVisitor = std::function<void(
    const mrpt::obs::CObservation3DRangeScan& scan,
    const CameraPose& camera,
    std::size_t keyframes)>;

/** Adds cloud and cameras from the keyframes of a .simplemap. One keyframe is in memory at a time.
 * \param visit Is called for each scan, if it is given. \exception std::runtime_error For a file
 * that cannot be read. The message names it. */
void addKeyframes(
    const std::string& simpleMapPath,
    const CloudOptions& options,
    SceneContent& content,
    const KeyframeVisitor& visit = {});

}  // namespace quadmap
