#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "quadmap/geometry/Plane.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/surfaces/DepthCloud.h"
#include "quadmap/surfaces/PlaneExtent.h"
#include "quadmap/surfaces/SurfaceOptions.h"

namespace quadmap
{
/** Finds the top of a thing that ends in a horizontal one, as a table does (doc/mathematics.md, 7):
 * the height at which the largest surface shows. It is found even when the camera sees it at an
 * angle too flat for a plane of the scene, down to a slope at which only the rim shows. What is
 * above the top stands on it. \param points Of every step-th cell of every step-th row in its box,
 * optical frame [m]. \param support What it stands on, normal up; null when that is not known: the
 * top may then have any height below the camera at which most points are not above it. \param up
 * Unit, optical frame, good to two degrees. \return Level, as far as the points do not tell a slope
 * against the support or up. Nothing when no height stands out, or, with a support, none is as high
 * above it as such things are. */
std::optional<Plane> horizontalTop(
    const DepthCloud& cloud,
    const std::vector<Eigen::Vector3d>& points,
    int step,
    const Plane* support,
    const Eigen::Vector3d& up,
    const LabelProperties& label,
    const SurfaceOptions& options);

/** How far an object's horizontal top reaches; the other parts of the object are below it. Nothing
 * is returned when no point lies on the top. \param points Of the object, optical frame [m]. */
std::optional<PlaneExtent> topExtent(
    const Plane& top, std::vector<Eigen::Vector3d> points, const SurfaceOptions& options);

}  // namespace quadmap
