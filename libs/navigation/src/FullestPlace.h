#pragma once

#include <vector>

#include "quadmap/maps/FrameLikelihood.h"

namespace quadmap
{
/** Mean of the poses in the fullest cell of a grid over places and yaws. The cells of yaw are equal
 * parts of the full turn, so that poses on both sides of half a turn may share one.
 * \param weights One for each pose, >= 0.
 * \param width Of a cell, in x and in y [m], > 0.
 * \param angle Of a cell in yaw, as nearly as whole parts of a turn allow [rad], > 0.
 */
LevelPose fullestPlace(
    const std::vector<LevelPose>& poses,
    const std::vector<double>& weights,
    double width,
    double angle);

}  // namespace quadmap
