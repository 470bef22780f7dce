#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "quadmap/geometry/Plane.h"
#include "quadmap/surfaces/SurfaceOptions.h"

namespace quadmap
{
/** The plane at the height that most points of a piece share. Flat things that lie on a surface are
 * segmented together with it, and the plane through both is neither. */
struct HorizontalFit
{
  Plane plane;                           //!< Normal up
  std::vector<Eigen::Vector3d> samples;  //!< Those of the points that are on it
};

/** \param points On a plane that faces about up, optical frame [m].
 *  \param normal Of the plane they were segmented as. The search starts with it, with `up` and with
 *  the plane through all points.
 *  \param up Unit vector, good to two degrees: small or far patches do not know better.
 *  \return Nothing when there are too few points. */
std::optional<HorizontalFit> fitMainHeight(
    const std::vector<Eigen::Vector3d>& points,
    const Eigen::Vector3d& normal,
    const Eigen::Vector3d& up,
    const SurfaceOptions& options);

}  // namespace quadmap
