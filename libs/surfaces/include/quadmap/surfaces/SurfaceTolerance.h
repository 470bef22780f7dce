#pragma once

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/Plane.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/surfaces/SurfaceOptions.h"

namespace quadmap
{
// How near to a surface a point of depth z must be to count as one of its points [m]. Each function
// is a bound at one depth: a part for what is uneven, and a multiple of the depth's standard
// deviation, equation (4.1).

/** Does a point lie on a plane of the frame? Equation (4.4). */
inline bool isOnPlane(const Eigen::Vector3d& p, const Plane& plane, const SurfaceOptions& options)
{
  return std::abs(plane.signedDistance(p)) <= options.onPlane(p.z());
}

/** Within this height two horizontal surfaces of one frame are one [m]: a keyboard, or the cover of
 * a book, is higher above the table. */
constexpr double kSameHeight = 0.02;

/** The bound for a surface that an object may stand on. It is wider than (4.4), because the point
 * may be where the object and the surface meet. */
inline double contactTolerance(double z, const SurfaceOptions& options)
{
  return options.planeTolerance + 2.5 * options.depthSigma(z);
}

/** The height above its support below which a point is not taken for the object's. A thin object (a
 * book) allows less than a tall one. */
inline double supportTolerance(
    double z, const LabelProperties& label, const SurfaceOptions& options)
{
  const double allowed = std::min(options.planeTolerance, 0.25 * label.typicalSize.z());
  return std::max(allowed, 2.5 * options.depthSigma(z));
}

/** The height from which on an object clears its support: it is more than the support's noise and
 * what was cut away with it. */
inline double clearOfSupport(double z, const LabelProperties& label, const SurfaceOptions& options)
{
  return 2.0 * supportTolerance(z, label, options);
}

/** The bound for the support when it is asked what hides an object. The support need not be even,
 * and does not hide what stands on it. \param noise What depth noise may add [m]. */
inline double unevenSupportTolerance(double noise)
{
  constexpr double kUneven = 0.03;  // [m]
  return kUneven + noise;
}

/** The height up to which a point counts as one of a horizontal top, and not of what stands on it.
 * \param perDepth By how much the height changes with the depth [-]. */
inline double topTolerance(double z, double perDepth, const SurfaceOptions& options)
{
  constexpr double kUneven = 0.01;  // [m]
  return kUneven + 2.5 * perDepth * options.depthSigma(z);
}

/** How much nearer than an object something must be to stand in front of it, equation (9.3). */
inline double depthTolerance(double z, const SurfaceOptions& options)
{
  return 0.05 + 3.0 * options.depthSigma(z);
}

}  // namespace quadmap
