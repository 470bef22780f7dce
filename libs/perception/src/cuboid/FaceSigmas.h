#pragma once

#include <cmath>
#include <cstddef>

#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
// Standard deviations of faces [m], fitted to simulated scenes with known truth; the table
// `observation_tables residuals` (doc/benchmarks.md) shows how well they hold.

/** A face is turned away above this cosine of its normal with the line of sight, and towards the
 * camera below its negative. In between only the outline shows it. */
inline constexpr double kTurnedAway = 0.25;

/** How far an object reaches, on average, beyond its outermost cells, equation (8.8) [m]: half a
 * cell, and more where its surface is seen at a flat angle, because depth is missing along edges.
 * \param away Cosine between the face's normal and the line of sight: > 0 faces away.
 * \param perCell Step of one cell along the normal [m]. */
inline double outlineShift(double away, double perCell)
{
  if (away < -kTurnedAway)
    return 0.0;  // the outermost point is no end of a line, but a point nearer to us
  return (away > kTurnedAway ? 1.0 : 0.5) * perCell;
}

/** Tukey's approximation of the quantile of the standard normal distribution. */
inline double normalQuantile(double share)
{
  return 4.91 * (std::pow(share, 0.14) - std::pow(1.0 - share, 0.14));
}

/** How far depth noise moves the n-th outermost (0: the outermost) of `count` points along a face's
 * normal, equation (8.9) [m]. It is Blom's plotting position. \param away Cosine between the face's
 * normal and the line of sight. */
inline double outlineNoise(double away, double depthSigma, std::size_t n, std::size_t count)
{
  if (std::abs(away) < kTurnedAway) return 0.0;
  const double beyond = (static_cast<double>(n) + 0.625) / (static_cast<double>(count) + 0.25);
  return normalQuantile(1.0 - beyond) * std::abs(away) * depthSigma;
}

/** How much farther the outline of something round is from the axis than it looks [m]. Its surface
 * turns away from the camera there. */
inline double roundShift(double cell) { return 0.5 * cell; }
inline double roundOutlineSigma(double radius, double outline)
{
  return std::hypot(0.05 * radius, outline);
}

/** A face by its own points: hardly any noise is left in the median of many; the steps of the
 * sensor's depth and what is not quite flat are. */
inline double surfaceSigma(double range, const PerceptionOptions& options)
{
  return std::hypot(0.00225, 0.29 * options.depthSigma(range));
}

/** The same of the top, which no heading moves. */
inline double topSurfaceSigma(double range, const PerceptionOptions& options)
{
  return std::hypot(0.0011, 0.17 * options.depthSigma(range));
}

/** The same of a horizontal top (table), whose height is found among all points of the thing. */
inline double horizontalTopSigma(double range, const PerceptionOptions& options)
{
  return std::hypot(0.0007, 0.10 * options.depthSigma(range));
}

inline double roundSurfaceSigma(double range, double radius, const PerceptionOptions& options)
{
  return std::hypot(0.06 * radius, surfaceSigma(range, options));
}

/** The far side of something as deep as it is wide. \param near Of its near side [m]. */
inline double roundFarSigma(double radius, double near) { return std::hypot(0.25 * radius, near); }

/** A side by its outline. \param perCell Step of one cell along the face's normal [m]. */
inline double outlineSigma(double perCell, double range, const PerceptionOptions& options)
{
  return std::hypot(std::hypot(0.003, 0.35 * perCell), 0.35 * options.depthSigma(range));
}

/** The same of a side that is turned away. */
inline double farEdgeSigma(double perCell, double range, const PerceptionOptions& options)
{
  return std::hypot(std::hypot(0.004, 0.3 * perCell), 0.45 * options.depthSigma(range));
}

/** The same of the top. */
inline double topEdgeSigma(double perCell, double range, const PerceptionOptions& options)
{
  return std::hypot(std::hypot(0.0023, 0.33 * perCell), 0.28 * options.depthSigma(range));
}

/** The same of a top that is seen from above: its highest point ends no line. */
inline double topFromAboveSigma(double perCell, double range, const PerceptionOptions& options)
{
  return std::hypot(std::hypot(0.0015, 0.24 * perCell), 0.19 * options.depthSigma(range));
}

/** A plane of many points, below the object. */
inline double supportSigma(double range, const PerceptionOptions& options)
{
  return std::hypot(0.00045, 0.048 * options.depthSigma(range));
}

}  // namespace quadmap
