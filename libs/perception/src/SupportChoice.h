#pragma once

#include <optional>

#include "DepthCloud.h"
#include "ScenePlanes.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Which horizontal plane an object stands on: for classes that stand on the floor the floor, for
 * others the plane that surrounds the lower part of the box and that the object rises above.
 * \param box The detector's box [px]. \return Index in ScenePlanes, or nothing. */
std::optional<int> chooseSupport(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ImageBox& box,
    UsualSupport usual,
    const PerceptionOptions& options);

}  // namespace quadmap
