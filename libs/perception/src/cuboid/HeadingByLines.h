#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "quadmap/geometry/LineFit.h"

namespace quadmap
{
/** Depth images are bent by their calibration: no direction is better than this [rad]. */
constexpr double kHeadingFloor = 0.2 * M_PI / 180.0;

/** Headings are tried in such steps [deg]; the lines correct the best of them. */
constexpr int kHeadingStep_deg = 2;

/** A heading by the lines that the sides of a thing make seen from above. */
struct LineHeading
{
  double yaw = 0;       //!< [rad]
  double variance = 0;  //!< [rad^2]
};

/** The line of the side whose normal is near a direction [rad], in the axes across and along that
 * direction; nothing where there is none. */
using SideLine = std::function<std::optional<LineFit>(double)>;

/** Corrects a heading by the weighted mean of the lines of all four sides, equation (8.4), and once
 * more about the corrected one, if it still has lines: those of real sides stay where they are.
 * \return Nothing when no side has a line within 10 degrees of the heading. */
std::optional<LineHeading> headingByLines(double yaw, const SideLine& lineOf);

}  // namespace quadmap
