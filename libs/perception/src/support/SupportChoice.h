#pragma once

#include <optional>
#include <vector>

#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/DepthCloud.h"
#include "quadmap/surfaces/ScenePlanes.h"

namespace quadmap
{
/** What the object of one box stands on or hangs at. */
struct BoxSupport
{
  std::optional<int> plane;  //!< Horizontal, index in ScenePlanes; nothing: unknown
  std::optional<int> wall;   //!< Vertical, index in ScenePlanes: its back is there
};

/** The planes of a frame with the tops of objects that other boxes stand on, and the support of
 * each box among them. */
struct SupportedScene
{
  ScenePlanes planes;
  std::vector<BoxSupport> supports;  //!< One for each box
};

/** Decides what the object of each box stands on or hangs at (doc/mathematics.md, 6). It looks at
 * the whole scene, because the top of one object may be the support of another. */
SupportedScene chooseSupports(
    const DepthCloud& cloud,
    ScenePlanes planes,
    const std::vector<DetectedObject>& boxes,
    const LabelTable& labels,
    const PerceptionOptions& options);

}  // namespace quadmap
