#pragma once

#include <optional>
#include <vector>

#include "DepthCloud.h"
#include "ScenePlanes.h"
#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** What the object of one box stands on or hangs at. */
struct BoxSupport
{
  std::optional<int> plane;  //!< Horizontal, index in ScenePlanes; nothing: unknown
  std::optional<int> wall;   //!< Vertical, index in ScenePlanes: its back is there
};

/** Decides the supports of all boxes of a frame with the whole scene in view.
 * \param planes Of the scene; tops of objects that other boxes stand on are added.
 * \return One for each box. */
std::vector<BoxSupport> chooseSupports(
    const DepthCloud& cloud,
    ScenePlanes& planes,
    const std::vector<DetectedObject>& boxes,
    const LabelTable& labels,
    const PerceptionOptions& options);

}  // namespace quadmap
