#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <vector>

#include "quadmap/surfaces/PlaneSegmentation.h"

namespace quadmap
{
/** By so much may the normals of planes that a depth camera sees be wrong [rad]. */
inline constexpr double kPlaneAccuracy = 5 * M_PI / 180;

/** The up direction by what is flat in a frame that shows no floor: tops of tables and cupboards,
 * walls, fronts of furniture. Most of this is horizontal or vertical (doc/mathematics.md, (15.11)).
 * \param guess Unit, optical frame. Directions more than 45 degrees from it are not tried: a camera
 * that looks down more steeply would take the walls for horizontal.
 * \return Unit. Nothing when too little of the image is flat. */
std::optional<Eigen::Vector3d> upOfRoom(
    const std::vector<ScenePlane>& planes, const Eigen::Vector3d& guess);

}  // namespace quadmap
