#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

namespace quadmap
{
/** A straight line through points (along, across): across = offset + along tan(angle). */
struct LineFit
{
  double angle = 0;     //!< [rad], in (-pi/2, pi/2)
  double variance = 0;  //!< Of the angle [rad^2]
  double share = 0;     //!< Of the points that lie on the line, in [0, 1]
};

/** Robust least squares. The variance comes from leaving out one tenth of the line at a time, so
 * that noise which neighbouring points share, and bends of the surface, count in full.
 * \param points (along, across) [m]. \param shell Points farther from the line are outliers [m].
 * \return Nothing for too few points or a line too short to have a direction. */
std::optional<LineFit> fitLine(std::vector<Eigen::Vector2d> points, double shell);

}  // namespace quadmap
