#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "quadmap/geometry/Plane.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** The one level that most of some points of horizontal surfaces share: flat things that lie on a
 * surface are segmented together with it, and a plane through both is neither. */
struct PlaneLevel
{
  Plane plane;                           //!< Normal up
  std::vector<Eigen::Vector3d> samples;  //!< Those of the points that are on it
};

/** \param points On a plane that faces about up, optical frame [m].
 *  \param normal Of the plane they were segmented as; it or `up` is where the search starts.
 *  \param up Unit vector, good to a degree: small or far patches do not know better.
 *  \return Nothing when there are too few points. */
std::optional<PlaneLevel> mainLevel(
    const std::vector<Eigen::Vector3d>& points,
    const Eigen::Vector3d& normal,
    const Eigen::Vector3d& up,
    const PerceptionOptions& options);

}  // namespace quadmap
