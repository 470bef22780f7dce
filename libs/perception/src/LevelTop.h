#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "DepthCloud.h"
#include "PlaneExtent.h"
#include "quadmap/geometry/Plane.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** The top of a thing that has a level one, as a table: the level that shows the largest surface,
 * also when it is seen too flat for a plane of the scene. What is above stands on it.
 * \param points Of every step-th cell of every step-th row in its box, optical frame [m].
 * \param support What it stands on; normal up.
 * \return Parallel to the support. Nothing when no level stands out or none is as high above the
 * support as such things are. */
std::optional<Plane> levelTop(
    const DepthCloud& cloud,
    const std::vector<Eigen::Vector3d>& points,
    int step,
    const Plane& support,
    const LabelProperties& label,
    const PerceptionOptions& options);

/** How far an object's level top reaches: its other parts are below it. Nothing when no point is on
 * the top. \param points Of the object, optical frame [m]. */
std::optional<PlaneExtent> topExtent(
    const Plane& top, std::vector<Eigen::Vector3d> points, const PerceptionOptions& options);

}  // namespace quadmap
