#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "quadmap/surfaces/PlaneSegmentation.h"

namespace quadmap
{
/** The up direction by what is flat in a frame that shows no floor: tops of tables and cupboards,
 * walls, fronts of furniture. People build level and upright, so it is the direction that most of
 * this is parallel to or at right angles with (doc/mathematics.md, (15.11)).
 * \param guess Unit, optical frame. Walls and levels change places with a direction far from it, so
 * only those within 45 degrees count.
 * \return Unit. Nothing when too little of the image is flat. */
std::optional<Eigen::Vector3d> upOfRoom(
    const std::vector<ScenePlane>& planes, const Eigen::Vector3d& guess);

}  // namespace quadmap
